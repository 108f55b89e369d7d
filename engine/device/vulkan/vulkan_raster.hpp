#pragma once

#include "device/raster.hpp"
#include "device/vulkan/raster_image.hpp"

#include <map>
#include <vector>

namespace argand::vulkan {

class VulkanDevice;

/// The rasteriser of a VulkanDevice. Images and render passes stay inside; results are buffers.
class VulkanRaster final : public Raster {
public:
    explicit VulkanRaster(VulkanDevice& device) : device_(device) {}
    VulkanRaster(const VulkanRaster&) = delete;
    VulkanRaster& operator=(const VulkanRaster&) = delete;
    ~VulkanRaster() override;

    void draw(const RasterInfo& program, const KernelArguments& arguments, std::uint32_t vertices,
              const RasterTarget& target) override;

private:
    // Frames of a film draw the same few sizes in turn.
    static constexpr std::size_t most_images = 2;

    /// A new one, unless one of the last ones has this size.
    std::shared_ptr<RasterImage> image(const RasterImageSize& size, VkRenderPass pass);

    VulkanDevice& device_;
    std::map<std::uint32_t, VkRenderPass> passes_;     ///< by words of a value
    std::vector<std::shared_ptr<RasterImage>> images_; ///< the last one first
};

} // namespace argand::vulkan
