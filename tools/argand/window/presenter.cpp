#include "presenter.hpp"

#include "device/vulkan/result.hpp"

#include <utility>

namespace argand::window {

namespace {

using vulkan::check;

constexpr const char* doing = "showing a window";

} // namespace

Presenter::Surface::~Surface() { vkDestroySurfaceKHR(instance->handle(), handle, nullptr); }

Presenter::Presenter(std::shared_ptr<vulkan::Instance> instance, VkSurfaceKHR surface,
                     const ShownPicture& font)
    : surface_{instance, surface}, device_(std::move(instance), surface),
      swapchain_(device_, surface), pipeline_(device_, swapchain_.pass()),
      font_(std::make_unique<Texture>(device_, font.width, font.height)),
      font_set_(pipeline_.make_set()), font_texels_(font) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device_.physical, &properties);
    most_side_ = static_cast<int>(properties.limits.maxImageDimension2D);
    pipeline_.show(font_set_, font_->view());
    for (Frame& frame : frames_) {
        make_frame(frame);
    }
    set_picture({.width = 1, .height = 1, .texels = {0, 0, 0, 255}});
}

Presenter::~Presenter() {
    vkDeviceWaitIdle(device_.device);
    for (Frame& frame : frames_) {
        vkDestroySemaphore(device_.device, frame.acquired, nullptr);
        vkDestroyFence(device_.device, frame.done, nullptr);
        vkDestroyCommandPool(device_.device, frame.pool, nullptr);
    }
}

void Presenter::make_frame(Frame& frame) {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = device_.family;
    check(vkCreateCommandPool(device_.device, &pool, nullptr, &frame.pool), doing);
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = frame.pool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device_.device, &allocate, &frame.commands), doing);
    VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    check(vkCreateFence(device_.device, &fence, nullptr, &frame.done), doing);
    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    check(vkCreateSemaphore(device_.device, &semaphore, nullptr, &frame.acquired), doing);
    frame.vertices = std::make_unique<HostBuffer>(device_, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    frame.indices = std::make_unique<HostBuffer>(device_, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    frame.picture_set = pipeline_.make_set();
}

void Presenter::set_picture(ShownPicture picture) {
    picture_ = std::move(picture);
    ++picture_version_;
}

/// Each frame in flight has a picture of its own, so that one is uploaded while another is shown.
void Presenter::upload_picture(Frame& frame) {
    if (frame.picture_version == picture_version_) {
        return;
    }
    if (!frame.picture || frame.picture->width() != picture_.width ||
        frame.picture->height() != picture_.height) {
        frame.picture = std::make_unique<Texture>(device_, picture_.width, picture_.height);
        pipeline_.show(frame.picture_set, frame.picture->view());
    }
    frame.picture->upload(frame.commands, picture_.texels);
    frame.picture_version = picture_version_;
}

void Presenter::record(Frame& frame, const ImDrawData& lists, std::uint32_t image) {
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(frame.commands, &begin), doing);
    if (!font_texels_.texels.empty()) {
        font_->upload(frame.commands, std::exchange(font_texels_, {}).texels);
    }
    upload_picture(frame);
    const VkClearValue clear{{{0.1f, 0.1f, 0.1f, 1.0f}}};
    VkRenderPassBeginInfo pass{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
    pass.renderPass = swapchain_.pass();
    pass.framebuffer = swapchain_.framebuffer(image);
    pass.renderArea = {{0, 0}, swapchain_.extent()};
    pass.clearValueCount = 1;
    pass.pClearValues = &clear;
    vkCmdBeginRenderPass(frame.commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
    pipeline_.draw(frame.commands, lists, *frame.vertices, *frame.indices);
    vkCmdEndRenderPass(frame.commands);
    check(vkEndCommandBuffer(frame.commands), doing);
}

void Presenter::present(const ImDrawData& lists, VkExtent2D size) {
    must_resize_ |= size.width != window_.width || size.height != window_.height;
    window_ = size;
    if (must_resize_) {
        must_resize_ = !swapchain_.resize(size);
    }
    // The surface may already be of another size than the lists were made for.
    const VkExtent2D extent = swapchain_.extent();
    if (must_resize_ || extent.width < size.width || extent.height < size.height) {
        must_resize_ = true;
        return;
    }
    Frame& frame = frames_[next_];
    check(vkWaitForFences(device_.device, 1, &frame.done, VK_TRUE, UINT64_MAX), doing);
    std::uint32_t image = 0;
    const VkResult acquired = vkAcquireNextImageKHR(device_.device, swapchain_.handle(), UINT64_MAX,
                                                    frame.acquired, VK_NULL_HANDLE, &image);
    if (acquired == VK_ERROR_OUT_OF_DATE_KHR) {
        must_resize_ = true;
        return;
    }
    if (acquired != VK_SUBOPTIMAL_KHR) {
        check(acquired, doing);
    }
    check(vkResetFences(device_.device, 1, &frame.done), doing);
    record(frame, lists, image);
    const VkPipelineStageFlags waits = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    const VkSemaphore drawn = swapchain_.drawn(image);
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.waitSemaphoreCount = 1;
    submit.pWaitSemaphores = &frame.acquired;
    submit.pWaitDstStageMask = &waits;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &frame.commands;
    submit.signalSemaphoreCount = 1;
    submit.pSignalSemaphores = &drawn;
    check(vkQueueSubmit(device_.queue, 1, &submit, frame.done), doing);
    const VkSwapchainKHR chain = swapchain_.handle();
    VkPresentInfoKHR present{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    present.waitSemaphoreCount = 1;
    present.pWaitSemaphores = &drawn;
    present.swapchainCount = 1;
    present.pSwapchains = &chain;
    present.pImageIndices = &image;
    const VkResult presented = vkQueuePresentKHR(device_.queue, &present);
    next_ = (next_ + 1) % frames_.size();
    if (presented == VK_ERROR_OUT_OF_DATE_KHR || presented == VK_SUBOPTIMAL_KHR) {
        must_resize_ = true;
        return;
    }
    check(presented, doing);
}

} // namespace argand::window
