#pragma once

#include "device/raster.hpp"
#include "device/vulkan/raster_image.hpp"

#include <map>

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
    /// Of the last size: draws of one size mostly follow one another.
    const std::shared_ptr<RasterImage>& image(const RasterImageSize& size, VkRenderPass pass);

    VulkanDevice& device_;
    std::map<std::uint32_t, VkRenderPass> passes_; ///< by words of a value
    std::shared_ptr<RasterImage> image_;
};

} // namespace argand::vulkan
