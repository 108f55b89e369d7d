#pragma once

#include "showing_device.hpp"

#include <vector>

namespace argand::window {

/// The images of a surface, of one size.
class Swapchain {
public:
    /// Throws Error if the surface has no format that shows 8 bits a channel as they are.
    Swapchain(const ShowingDevice& device, VkSurfaceKHR surface);
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;
    /// Waits until no image is in use.
    ~Swapchain();

    /// Makes the images anew for a surface whose size in pixels is now this. Returns false, and has
    /// none, if that is nothing: the window is minimised.
    bool resize(VkExtent2D size);

    VkSwapchainKHR handle() const { return swapchain_; }
    VkRenderPass pass() const { return pass_; }
    VkExtent2D extent() const { return extent_; }
    VkFramebuffer framebuffer(std::uint32_t image) const { return images_[image].framebuffer; }
    /// Signalled once an image is drawn; the presentation waits for it.
    VkSemaphore drawn(std::uint32_t image) const { return images_[image].drawn; }

private:
    struct Image {
        VkImageView view = VK_NULL_HANDLE;
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        VkSemaphore drawn = VK_NULL_HANDLE;
    };
    void add(VkImage image);
    void release_images();

    const ShowingDevice& device_;
    VkSurfaceKHR surface_;
    VkSurfaceFormatKHR format_{};
    VkRenderPass pass_ = VK_NULL_HANDLE;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<Image> images_;
};

} // namespace argand::window
