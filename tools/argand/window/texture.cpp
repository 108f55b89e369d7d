#include "texture.hpp"

#include "device/vulkan/result.hpp"

#include <cstring>

namespace argand::window {

namespace {

using vulkan::check;

constexpr VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

void change_layout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to,
                   VkPipelineStageFlags before, VkAccessFlags wrote, VkPipelineStageFlags after,
                   VkAccessFlags reads) {
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.srcAccessMask = wrote;
    barrier.dstAccessMask = reads;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = whole;
    vkCmdPipelineBarrier(commands, before, after, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

} // namespace

Texture::Texture(const ShowingDevice& device, int width, int height)
    : device_(device), width_(width), height_(height),
      staging_(device, VK_BUFFER_USAGE_TRANSFER_SRC_BIT) {
    VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = VK_FORMAT_R8G8B8A8_UNORM;
    create.extent = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), 1};
    create.mipLevels = 1;
    create.arrayLayers = 1;
    create.samples = VK_SAMPLE_COUNT_1_BIT;
    create.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    check(vkCreateImage(device_.device, &create, nullptr, &image_), "showing a picture");
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device_.device, image_, &needs);
    memory_ = device_.allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "showing a picture");
    check(vkBindImageMemory(device_.device, image_, memory_, 0), "showing a picture");
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = image_;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = create.format;
    view.subresourceRange = whole;
    check(vkCreateImageView(device_.device, &view, nullptr, &view_), "showing a picture");
}

Texture::~Texture() {
    vkDestroyImageView(device_.device, view_, nullptr);
    vkDestroyImage(device_.device, image_, nullptr);
    vkFreeMemory(device_.device, memory_, nullptr);
}

void Texture::upload(VkCommandBuffer commands, std::span<const std::uint8_t> texels) {
    std::memcpy(staging_.map(texels.size()), texels.data(), texels.size());
    // What it held before does not matter, but draws that read it must be over.
    change_layout(commands, image_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                  VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, VK_PIPELINE_STAGE_TRANSFER_BIT,
                  VK_ACCESS_TRANSFER_WRITE_BIT);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {static_cast<std::uint32_t>(width_), static_cast<std::uint32_t>(height_), 1};
    vkCmdCopyBufferToImage(commands, staging_.handle(), image_,
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    change_layout(commands, image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                  VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                  VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                  VK_ACCESS_SHADER_READ_BIT);
}

} // namespace argand::window
