#pragma once

#include "showing_device.hpp"

#include <imgui.h>

namespace argand::window {

/// Draws Dear ImGui's lists. Debian's own renderer for Vulkan calls functions by names that volk
/// defines as pointers, so it cannot be linked.
class UiPipeline {
public:
    /// For a render pass with one colour attachment.
    UiPipeline(const ShowingDevice& device, VkRenderPass pass);
    UiPipeline(const UiPipeline&) = delete;
    UiPipeline& operator=(const UiPipeline&) = delete;
    ~UiPipeline();

    /// A descriptor set, never freed, for one image at a time: see show().
    VkDescriptorSet make_set();
    /// Lets the set show an image. It must not be in use.
    void show(VkDescriptorSet set, VkImageView image);

    /// Records the lists. Of each command, the texture is a descriptor set. vertices, indices: for
    /// these lists, not in use.
    void draw(VkCommandBuffer commands, const ImDrawData& lists, HostBuffer& vertices,
              HostBuffer& indices);

private:
    const ShowingDevice& device_;
    VkSampler sampler_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

} // namespace argand::window
