#include "device/vulkan/pipelines.hpp"

#include "base/atomic_write.hpp"
#include "base/environment.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"
#include "device/vulkan/result.hpp"

namespace argand::vulkan {

namespace {

std::filesystem::path cache_file_of(const VkPhysicalDeviceProperties& properties) {
    const std::filesystem::path directory = cache_directory();
    if (directory.empty()) {
        return {};
    }
    std::string id;
    for (const std::uint8_t byte : properties.pipelineCacheUUID) {
        id += fmt::format("{:02x}", byte);
    }
    return directory /
           fmt::format("pipelines-{:x}-{:x}-{}.bin", properties.vendorID, properties.deviceID, id);
}

/// Returns the cache file's contents. An unreadable file counts as empty because the cache is
/// optional; drivers reject a file that is not theirs.
std::vector<std::uint8_t> read_if_exists(const std::filesystem::path& file) {
    try {
        return read_file(file);
    } catch (const Error&) {
        return {};
    }
}

} // namespace

Pipelines::Pipelines(VkDevice device, bool push_descriptors,
                     const VkPhysicalDeviceProperties& properties)
    : device_(device), push_descriptors_(push_descriptors), cache_file_(cache_file_of(properties)) {
    const std::vector<std::uint8_t> data = read_if_exists(cache_file_);
    VkPipelineCacheCreateInfo create{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    create.initialDataSize = data.size();
    create.pInitialData = data.data();
    check(vkCreatePipelineCache(device_, &create, nullptr, &cache_), "opening the pipeline cache");
}

Pipelines::~Pipelines() {
    save();
    for (const auto& [key, pipeline] : pipelines_) {
        vkDestroyPipeline(device_, pipeline.pipeline, nullptr);
    }
    for (const auto& [key, layout] : pipeline_layouts_) {
        vkDestroyPipelineLayout(device_, layout, nullptr);
    }
    for (const auto& [key, layout] : set_layouts_) {
        vkDestroyDescriptorSetLayout(device_, layout, nullptr);
    }
    vkDestroyPipelineCache(device_, cache_, nullptr);
}

void Pipelines::save() const {
    std::size_t size = 0;
    if (cache_file_.empty() || pipelines_.empty() ||
        vkGetPipelineCacheData(device_, cache_, &size, nullptr) != VK_SUCCESS) {
        return;
    }
    std::vector<std::uint8_t> data(size);
    if (vkGetPipelineCacheData(device_, cache_, &size, data.data()) != VK_SUCCESS) {
        return;
    }
    data.resize(size);
    if (data == read_if_exists(cache_file_)) {
        return;
    }
    std::error_code ignored;
    std::filesystem::create_directories(cache_file_.parent_path(), ignored);
    try {
        write_atomically(cache_file_, data);
    } catch (const Error&) {
        // The next process compiles the kernels again.
    }
}

VkDescriptorSetLayout Pipelines::set_layout(Slots slots) {
    VkDescriptorSetLayout& layout = set_layouts_[slots];
    if (!layout) {
        std::vector<VkDescriptorSetLayoutBinding> bindings(slots.count);
        for (std::uint32_t i = 0; i < slots.count; ++i) {
            const VkDescriptorType type = (slots.texels >> i & 1) != 0
                                              ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER
                                              : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            bindings[i] = {i, type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
        }
        VkDescriptorSetLayoutCreateInfo create{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
        create.flags =
            push_descriptors_ ? VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR : 0;
        create.bindingCount = slots.count;
        create.pBindings = bindings.data();
        check(vkCreateDescriptorSetLayout(device_, &create, nullptr, &layout),
              "creating a descriptor set layout");
    }
    return layout;
}

VkPipelineLayout Pipelines::pipeline_layout(Slots slots, std::uint32_t push_bytes) {
    VkPipelineLayout& layout = pipeline_layouts_[{slots, push_bytes}];
    if (!layout) {
        const VkDescriptorSetLayout set = set_layout(slots);
        const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
        VkPipelineLayoutCreateInfo create{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
        create.setLayoutCount = 1;
        create.pSetLayouts = &set;
        create.pushConstantRangeCount = push_bytes > 0 ? 1 : 0;
        create.pPushConstantRanges = &range;
        check(vkCreatePipelineLayout(device_, &create, nullptr, &layout),
              "creating a pipeline layout");
    }
    return layout;
}

const Pipeline& Pipelines::get(const KernelInfo& kernel, const KernelArguments& arguments) {
    Key key{&kernel,
            {arguments.constants.begin(), arguments.constants.begin() + arguments.constant_count}};
    Pipeline& pipeline = pipelines_[key];
    if (pipeline.pipeline) {
        return pipeline;
    }
    const std::string doing = fmt::format("compiling kernel {}", kernel.name);

    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < arguments.constant_count; ++i) {
        entries.push_back({kernel.constants[i].id, i * 4, 4});
    }
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()),
                                              entries.data(), arguments.constant_count * 4,
                                              arguments.constants.data()};

    VkShaderModuleCreateInfo module_create{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    const std::span<const std::uint32_t> spirv = module_for(kernel, key.second);
    module_create.codeSize = spirv.size_bytes();
    module_create.pCode = spirv.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device_, &module_create, nullptr, &module), doing);

    Slots slots{static_cast<std::uint32_t>(kernel.bindings.size()), 0};
    for (const KernelBinding& binding : kernel.bindings) {
        slots.texels |= binding.texels ? 1u << binding.binding : 0u;
    }
    pipeline.set_layout = set_layout(slots);
    pipeline.layout = pipeline_layout(slots, kernel.push_bytes);
    VkComputePipelineCreateInfo create{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    create.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    create.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    create.stage.module = module;
    create.stage.pName = "main";
    create.stage.pSpecializationInfo = &specialization;
    create.layout = pipeline.layout;
    const VkResult result =
        vkCreateComputePipelines(device_, cache_, 1, &create, nullptr, &pipeline.pipeline);
    vkDestroyShaderModule(device_, module, nullptr);
    check(result, doing);
    return pipeline;
}

} // namespace argand::vulkan
