#pragma once

#include "device/vulkan/memory.hpp"

namespace argand::vulkan {

/// What a raster image holds.
struct RasterImageSize {
    std::uint32_t width = 0, height = 0, layers = 0; ///< pixels
    std::uint32_t words = 0;                         ///< of a value
    bool operator==(const RasterImageSize&) const = default;
};

/// Depth is from 0, which is far, to 1.
inline constexpr VkFormat depth_format = VK_FORMAT_D32_SFLOAT;

/// The format of a value of 1, 2 or 4 words.
VkFormat color_format(std::uint32_t words);

/// A render pass that clears such attachments, and leaves the color to be copied.
VkRenderPass make_render_pass(VkDevice device, std::uint32_t words);

/// A color and a depth attachment, each of several layers, and their framebuffer.
struct RasterImage {
    RasterImageSize size;
    std::shared_ptr<LogicalDevice> device;
    std::weak_ptr<DeviceMemory> ledger; ///< expired if the image has outlived its device
    std::uint64_t bytes = 0;            ///< of the memory
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImage color = VK_NULL_HANDLE, depth = VK_NULL_HANDLE;
    VkImageView color_view = VK_NULL_HANDLE, depth_view = VK_NULL_HANDLE;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;

    RasterImage() = default;
    RasterImage(const RasterImage&) = delete;
    RasterImage& operator=(const RasterImage&) = delete;
    ~RasterImage();
};

/// Null if memory has run out. Throws Error if the device does not have so much.
std::shared_ptr<RasterImage> make_raster_image(VkPhysicalDevice physical,
                                               const std::shared_ptr<LogicalDevice>& device,
                                               const std::shared_ptr<DeviceMemory>& ledger,
                                               const DeviceInfo& info, VkRenderPass pass,
                                               const RasterImageSize& size);

} // namespace argand::vulkan
