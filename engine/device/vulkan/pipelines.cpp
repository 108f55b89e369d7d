#include "device/vulkan/pipelines.hpp"

#include "base/atomic_write.hpp"
#include "base/environment.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"
#include "device/vulkan/raster_pipeline.hpp"
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

/// A module that lives while a pipeline is made of it.
struct Module {
    VkDevice device;
    VkShaderModule handle = VK_NULL_HANDLE;

    Module(VkDevice of, std::span<const std::uint32_t> spirv, const std::string& doing)
        : device(of) {
        VkShaderModuleCreateInfo create{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
        create.codeSize = spirv.size_bytes();
        create.pCode = spirv.data();
        check(vkCreateShaderModule(device, &create, nullptr, &handle), doing);
    }
    Module(const Module&) = delete;
    Module& operator=(const Module&) = delete;
    ~Module() { vkDestroyShaderModule(device, handle, nullptr); }
};

/// Values of specialization constants, as pipelines take them.
struct Specialization {
    std::vector<VkSpecializationMapEntry> entries;
    VkSpecializationInfo info{};

    Specialization(std::span<const KernelConstant> constants, const KernelArguments& arguments) {
        for (std::uint32_t i = 0; i < arguments.constant_count; ++i) {
            entries.push_back({constants[i].id, i * 4, 4});
        }
        info = {static_cast<std::uint32_t>(entries.size()), entries.data(),
                arguments.constant_count * 4, arguments.constants.data()};
    }
    Specialization(const Specialization&) = delete;
    Specialization& operator=(const Specialization&) = delete;
};

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
            bindings[i] = {i, type, 1, slots.stages, nullptr};
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
        const VkPushConstantRange range{slots.stages, 0, push_bytes};
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

void Pipelines::add_layouts(Pipeline& pipeline, std::span<const KernelBinding> bindings,
                            std::uint32_t push_bytes, VkShaderStageFlags stages) {
    Slots slots{static_cast<std::uint32_t>(bindings.size()), 0, stages};
    for (const KernelBinding& binding : bindings) {
        slots.texels |= binding.texels ? 1u << binding.binding : 0u;
    }
    pipeline.set_layout = set_layout(slots);
    pipeline.layout = pipeline_layout(slots, push_bytes);
}

const Pipeline& Pipelines::get(const KernelInfo& kernel, const KernelArguments& arguments) {
    Key key{&kernel,
            {arguments.constants.begin(), arguments.constants.begin() + arguments.constant_count}};
    Pipeline& pipeline = pipelines_[key];
    if (pipeline.pipeline) {
        return pipeline;
    }
    const std::string doing = fmt::format("compiling kernel {}", kernel.name);

    const Specialization specialization(kernel.constants, arguments);
    const Module module(device_, module_for(kernel, key.second), doing);
    add_layouts(pipeline, kernel.bindings, kernel.push_bytes, VK_SHADER_STAGE_COMPUTE_BIT);
    VkComputePipelineCreateInfo create{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    create.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    create.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    create.stage.module = module.handle;
    create.stage.pName = "main";
    create.stage.pSpecializationInfo = &specialization.info;
    create.layout = pipeline.layout;
    check(vkCreateComputePipelines(device_, cache_, 1, &create, nullptr, &pipeline.pipeline),
          doing);
    return pipeline;
}

const Pipeline& Pipelines::get(const RasterInfo& program, const KernelArguments& arguments,
                               VkRenderPass pass) {
    Key key{&program,
            {arguments.constants.begin(), arguments.constants.begin() + arguments.constant_count}};
    Pipeline& pipeline = pipelines_[key];
    if (pipeline.pipeline) {
        return pipeline;
    }
    const std::string doing = fmt::format("compiling raster program {}", program.name);
    const Specialization specialization(program.constants, arguments);
    add_layouts(pipeline, program.bindings, program.push_bytes, raster_stages);
    const Module vertex(device_, program.vertex, doing);
    const Module fragment(device_, program.fragment, doing);
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (const bool is_fragment : {false, true}) {
        VkPipelineShaderStageCreateInfo& stage = stages[is_fragment ? 1 : 0];
        stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stage.stage = is_fragment ? VK_SHADER_STAGE_FRAGMENT_BIT : VK_SHADER_STAGE_VERTEX_BIT;
        stage.module = (is_fragment ? fragment : vertex).handle;
        stage.pName = "main";
        stage.pSpecializationInfo = &specialization.info;
    }
    check(create_raster_pipeline(device_, cache_, stages, pipeline.layout, pass, pipeline.pipeline),
          doing);
    return pipeline;
}

} // namespace argand::vulkan
