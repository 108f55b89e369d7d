#include "ui_pipeline.hpp"

#include "device/vulkan/result.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <ui.frag.h> // made by the build
#include <ui.vert.h>

namespace argand::window {

namespace {

using vulkan::check;

constexpr std::uint32_t most_sets = 8;
constexpr const char* doing = "preparing a window";

/// From pixels to Vulkan's clip space.
struct Push {
    std::array<float, 2> scale, offset;
};

VkShaderModule shader(VkDevice device, std::span<const std::uint32_t> code) {
    VkShaderModuleCreateInfo create{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    create.codeSize = code.size_bytes();
    create.pCode = code.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device, &create, nullptr, &module), doing);
    return module;
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits of, VkShaderModule module) {
    VkPipelineShaderStageCreateInfo create{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    create.stage = of;
    create.module = module;
    create.pName = "main";
    return create;
}

VkPipeline make_pipeline(VkDevice device, VkPipelineLayout layout, VkRenderPass pass) {
    const VkShaderModule vertex = shader(device, ui_vert), fragment = shader(device, ui_frag);
    const std::array stages{stage(VK_SHADER_STAGE_VERTEX_BIT, vertex),
                            stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment)};
    const VkVertexInputBindingDescription binding{0, sizeof(ImDrawVert),
                                                  VK_VERTEX_INPUT_RATE_VERTEX};
    const std::array<VkVertexInputAttributeDescription, 3> attributes{
        {{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, pos)},
         {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, uv)},
         {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(ImDrawVert, col)}}};
    VkPipelineVertexInputStateCreateInfo input{
        VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    input.vertexBindingDescriptionCount = 1;
    input.pVertexBindingDescriptions = &binding;
    input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
    input.pVertexAttributeDescriptions = attributes.data();
    VkPipelineInputAssemblyStateCreateInfo assembly{
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{
        VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.cullMode = VK_CULL_MODE_NONE;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples{
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineColorBlendAttachmentState blend{};
    blend.blendEnable = VK_TRUE;
    blend.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
    blend.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blend.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blend.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                           VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    VkPipelineColorBlendStateCreateInfo blending{
        VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blending.attachmentCount = 1;
    blending.pAttachments = &blend;
    const std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();
    VkGraphicsPipelineCreateInfo create{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    create.stageCount = static_cast<std::uint32_t>(stages.size());
    create.pStages = stages.data();
    create.pVertexInputState = &input;
    create.pInputAssemblyState = &assembly;
    create.pViewportState = &viewport;
    create.pRasterizationState = &raster;
    create.pMultisampleState = &samples;
    create.pColorBlendState = &blending;
    create.pDynamicState = &dynamic;
    create.layout = layout;
    create.renderPass = pass;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result =
        vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &create, nullptr, &pipeline);
    vkDestroyShaderModule(device, vertex, nullptr);
    vkDestroyShaderModule(device, fragment, nullptr);
    check(result, doing);
    return pipeline;
}

/// The part of the window that a command draws on, in pixels of the framebuffer.
VkRect2D scissor_of(const ImDrawCmd& command, const ImDrawData& lists) {
    const auto pixels = [](float at, float from, float scale, float most) {
        return std::clamp((at - from) * scale, 0.0f, most);
    };
    const ImVec2 scale = lists.FramebufferScale;
    const float width = lists.DisplaySize.x * scale.x, height = lists.DisplaySize.y * scale.y;
    const float x0 = pixels(command.ClipRect.x, lists.DisplayPos.x, scale.x, width);
    const float y0 = pixels(command.ClipRect.y, lists.DisplayPos.y, scale.y, height);
    const float x1 = pixels(command.ClipRect.z, lists.DisplayPos.x, scale.x, width);
    const float y1 = pixels(command.ClipRect.w, lists.DisplayPos.y, scale.y, height);
    return {{static_cast<std::int32_t>(x0), static_cast<std::int32_t>(y0)},
            {static_cast<std::uint32_t>(std::max(x1 - x0, 0.0f)),
             static_cast<std::uint32_t>(std::max(y1 - y0, 0.0f))}};
}

} // namespace

UiPipeline::UiPipeline(const ShowingDevice& device, VkRenderPass pass) : device_(device) {
    VkSamplerCreateInfo sampler{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    sampler.magFilter = VK_FILTER_LINEAR;
    sampler.minFilter = VK_FILTER_LINEAR;
    sampler.addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    sampler.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    sampler.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    check(vkCreateSampler(device_.device, &sampler, nullptr, &sampler_), doing);
    const VkDescriptorSetLayoutBinding binding{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                               VK_SHADER_STAGE_FRAGMENT_BIT, &sampler_};
    VkDescriptorSetLayoutCreateInfo sets{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    sets.bindingCount = 1;
    sets.pBindings = &binding;
    check(vkCreateDescriptorSetLayout(device_.device, &sets, nullptr, &set_layout_), doing);
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, most_sets};
    VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool.maxSets = most_sets;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    check(vkCreateDescriptorPool(device_.device, &pool, nullptr, &pool_), doing);
    const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Push)};
    VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout_;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &push;
    check(vkCreatePipelineLayout(device_.device, &layout, nullptr, &layout_), doing);
    pipeline_ = make_pipeline(device_.device, layout_, pass);
}

UiPipeline::~UiPipeline() {
    vkDestroyPipeline(device_.device, pipeline_, nullptr);
    vkDestroyPipelineLayout(device_.device, layout_, nullptr);
    vkDestroyDescriptorPool(device_.device, pool_, nullptr);
    vkDestroyDescriptorSetLayout(device_.device, set_layout_, nullptr);
    vkDestroySampler(device_.device, sampler_, nullptr);
}

VkDescriptorSet UiPipeline::make_set() {
    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorPool = pool_;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &set_layout_;
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vkAllocateDescriptorSets(device_.device, &allocate, &set), doing);
    return set;
}

void UiPipeline::show(VkDescriptorSet set, VkImageView image) {
    const VkDescriptorImageInfo info{VK_NULL_HANDLE, image,
                                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &info;
    vkUpdateDescriptorSets(device_.device, 1, &write, 0, nullptr);
}

void UiPipeline::draw(VkCommandBuffer commands, const ImDrawData& lists, HostBuffer& vertices,
                      HostBuffer& indices) {
    if (lists.TotalVtxCount == 0 || lists.TotalIdxCount == 0) {
        return;
    }
    std::byte* to_vertices =
        vertices.map(static_cast<VkDeviceSize>(lists.TotalVtxCount) * sizeof(ImDrawVert));
    std::byte* to_indices =
        indices.map(static_cast<VkDeviceSize>(lists.TotalIdxCount) * sizeof(ImDrawIdx));
    const std::span<ImDrawList* const> all(lists.CmdLists,
                                           static_cast<std::size_t>(lists.CmdListsCount));
    for (const ImDrawList* list : all) {
        const auto append = [](std::byte*& to, const void* from, int size_in_bytes) {
            std::memcpy(to, from, static_cast<std::size_t>(size_in_bytes));
            to += size_in_bytes;
        };
        append(to_vertices, list->VtxBuffer.Data, list->VtxBuffer.size_in_bytes());
        append(to_indices, list->IdxBuffer.Data, list->IdxBuffer.size_in_bytes());
    }
    const VkDeviceSize start = 0;
    const VkBuffer vertex_buffer = vertices.handle();
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &start);
    vkCmdBindIndexBuffer(commands, indices.handle(), 0,
                         sizeof(ImDrawIdx) == 2 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
    const ImVec2 size = lists.DisplaySize, scale = lists.FramebufferScale;
    const VkViewport viewport{0, 0, size.x * scale.x, size.y * scale.y, 0, 1};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    const std::array<float, 2> factor{2 / size.x, 2 / size.y};
    const Push push{factor,
                    {-1 - lists.DisplayPos.x * factor[0], -1 - lists.DisplayPos.y * factor[1]}};
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(push), &push);
    std::uint32_t first_index = 0;
    std::int32_t first_vertex = 0;
    for (const ImDrawList* list : all) {
        for (const ImDrawCmd& command : list->CmdBuffer) {
            const VkRect2D scissor = scissor_of(command, lists);
            if (command.UserCallback != nullptr || scissor.extent.width == 0 ||
                scissor.extent.height == 0) {
                continue;
            }
            vkCmdSetScissor(commands, 0, 1, &scissor);
            const auto set = static_cast<VkDescriptorSet>(command.GetTexID());
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set,
                                    0, nullptr);
            vkCmdDrawIndexed(commands, command.ElemCount, 1, first_index + command.IdxOffset,
                             first_vertex + static_cast<std::int32_t>(command.VtxOffset), 0);
        }
        first_index += static_cast<std::uint32_t>(list->IdxBuffer.Size);
        first_vertex += list->VtxBuffer.Size;
    }
}

} // namespace argand::window
