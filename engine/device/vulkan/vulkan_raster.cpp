#include "device/vulkan/vulkan_raster.hpp"

#include "base/error.hpp"
#include "device/vulkan/raster_pipeline.hpp"
#include "device/vulkan/vulkan_device.hpp"

#include <algorithm>
#include <array>

namespace argand::vulkan {

VulkanRaster::~VulkanRaster() {
    for (const auto& [key, pass] : passes_) {
        vkDestroyRenderPass(device_.device_->handle, pass, nullptr);
    }
}

std::shared_ptr<RasterImage> VulkanRaster::image(const RasterImageSize& size, VkRenderPass pass) {
    const auto found = std::find_if(images_.begin(), images_.end(),
                                    [&](const auto& image) { return image->size == size; });
    std::shared_ptr<RasterImage> used;
    if (found != images_.end()) {
        used = *found;
        images_.erase(found);
    } else {
        const auto make = [&] {
            return make_raster_image(device_.physical_, device_.device_, device_.memory_,
                                     device_.info_, pass, size);
        };
        images_.resize(std::min(images_.size(), most_images - 1)); // freed before the new one
        used = make();
        if (!used) {
            images_.clear();
            device_.wait(); // frees what recorded commands have kept
            used = make();
        }
        if (!used) {
            fail_out_of_memory(device_.memory_->ledger(), "raster image",
                               std::uint64_t(size.width) * size.height * size.layers *
                                   (size.words + 1) * sizeof(std::uint32_t));
        }
    }
    images_.insert(images_.begin(), used);
    return used;
}

void VulkanRaster::draw(const RasterInfo& program, const KernelArguments& arguments,
                        std::uint32_t vertices, const RasterTarget& target) {
    const RasterImageSize size{target.width, target.height, target.layers, program.words};
    const Limits& limits = device_.info_.limits;
    if (size.width == 0 || size.height == 0 || size.layers == 0 || size.width > limits.image ||
        size.height > limits.image || size.layers > limits.layers) {
        fail("drawing {}: {} x {} pixels in {} layers; '{}' draws 1 x 1 to {} x {} in up to {}",
             program.name, size.width, size.height, size.layers, device_.info_.name, limits.image,
             limits.image, limits.layers);
    }
    VkRenderPass& pass = passes_[size.words];
    if (!pass) {
        pass = make_render_pass(device_.device_->handle, size.words);
    }
    const std::shared_ptr<RasterImage> drawn = image(size, pass);
    // Compiled first: if that fails, no render pass is left open.
    const Pipeline& pipeline = device_.pipelines_->get(program, arguments, pass);

    std::array<VulkanDevice::Use, max_bindings + 1> uses;
    for (std::uint32_t i = 0; i < arguments.buffer_count; ++i) {
        uses[i] = {arguments.buffers[i], Access::read};
    }
    uses[arguments.buffer_count] = {target.to.buffer, Access::write};
    device_.barrier_for({uses.data(), arguments.buffer_count + 1});
    device_.keep_alive(drawn);

    const VkCommandBuffer commands = device_.commands();
    std::array<VkClearValue, 2> clear{};
    std::copy(target.empty.begin(), target.empty.end(), clear[0].color.uint32);
    VkRenderPassBeginInfo begin{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
    begin.renderPass = pass;
    begin.framebuffer = drawn->framebuffer;
    begin.renderArea.extent = {size.width, size.height};
    begin.clearValueCount = clear.size();
    begin.pClearValues = clear.data();
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    if (vertices > 0) {
        device_.bind({.name = program.name,
                      .bindings = program.bindings,
                      .push_bytes = program.push_bytes,
                      .pipeline = pipeline,
                      .point = VK_PIPELINE_BIND_POINT_GRAPHICS,
                      .stages = raster_stages},
                     arguments);
        const VkViewport viewport{0, 0, float(size.width), float(size.height), 0, 1};
        vkCmdSetViewport(commands, 0, 1, &viewport);
        vkCmdSetScissor(commands, 0, 1, &begin.renderArea);
        vkCmdDraw(commands, vertices, size.layers, 0, 0);
    }
    vkCmdEndRenderPass(commands);
    VkBufferImageCopy region{};
    region.bufferOffset = target.to.offset;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, size.layers};
    region.imageExtent = {size.width, size.height, 1};
    vkCmdCopyImageToBuffer(commands, drawn->color, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           block_of<VulkanBlock>(*target.to.buffer).buffer, 1, &region);
}

} // namespace argand::vulkan
