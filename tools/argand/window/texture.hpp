#pragma once

#include "showing_device.hpp"

#include <span>

namespace argand::window {

/// An image of 8 bits a channel, RGBA, that a fragment shader samples.
class Texture {
public:
    Texture(const ShowingDevice& device, int width, int height);
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;
    ~Texture();

    /// Records the upload of all texels: width × height × 4 bytes.
    void upload(VkCommandBuffer commands, std::span<const std::uint8_t> texels);

    VkImageView view() const { return view_; }
    int width() const { return width_; }
    int height() const { return height_; }

private:
    const ShowingDevice& device_;
    int width_, height_;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    HostBuffer staging_;
};

} // namespace argand::window
