#pragma once

#include <span>
#include <volk.h>

namespace argand::vulkan {

inline constexpr VkShaderStageFlags raster_stages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// The pipeline of a raster program: triangles without vertex inputs, seen from both sides, a depth
/// buffer that keeps the largest depth, and one color attachment.
VkResult create_raster_pipeline(VkDevice device, VkPipelineCache cache,
                                std::span<const VkPipelineShaderStageCreateInfo> stages,
                                VkPipelineLayout layout, VkRenderPass pass, VkPipeline& pipeline);

} // namespace argand::vulkan
