#pragma once

#include "device/raster.hpp"

#include <compare>
#include <filesystem>
#include <map>
#include <vector>
#include <volk.h>

namespace argand::vulkan {

struct Pipeline {
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
};

/// Pipelines of a device, created on first use and cached on disk between processes.
class Pipelines {
public:
    Pipelines(VkDevice device, bool push_descriptors, const VkPhysicalDeviceProperties& properties);
    Pipelines(const Pipelines&) = delete;
    Pipelines& operator=(const Pipelines&) = delete;
    ~Pipelines();

    const Pipeline& get(const KernelInfo& kernel, const KernelArguments& arguments);
    /// The pipeline of a raster program that draws in a render pass for its values.
    const Pipeline& get(const RasterInfo& program, const KernelArguments& arguments,
                        VkRenderPass pass);

private:
    /// A kernel or a raster program, and the values of its specialization constants.
    using Key = std::pair<const void*, std::vector<std::uint32_t>>;

    /// Number of buffers that a kernel binds, a bit mask of those bound as texels, and the stages
    /// that see them.
    struct Slots {
        std::uint32_t count = 0;
        std::uint32_t texels = 0;
        VkShaderStageFlags stages = VK_SHADER_STAGE_COMPUTE_BIT;
        auto operator<=>(const Slots&) const = default; // NOLINT(modernize-use-nullptr)
    };

    VkDescriptorSetLayout set_layout(Slots slots);
    VkPipelineLayout pipeline_layout(Slots slots, std::uint32_t push_bytes);
    void add_layouts(Pipeline& pipeline, std::span<const KernelBinding> bindings,
                     std::uint32_t push_bytes, VkShaderStageFlags stages);
    void save() const;

    VkDevice device_;
    bool push_descriptors_;
    std::filesystem::path cache_file_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
    std::map<Slots, VkDescriptorSetLayout> set_layouts_;
    std::map<std::pair<Slots, std::uint32_t>, VkPipelineLayout> pipeline_layouts_;
    std::map<Key, Pipeline> pipelines_;
};

} // namespace argand::vulkan
