#include "base/error.hpp"
#include "device/vulkan/instance.hpp"
#include "device/vulkan/raster_image.hpp"
#include "device/vulkan/result.hpp"

#include <algorithm>

namespace argand::vulkan {

std::vector<std::string> device_extensions(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr),
          "listing device extensions");
    std::vector<VkExtensionProperties> properties(count);
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, properties.data()),
          "listing device extensions");
    std::vector<std::string> names;
    names.reserve(count);
    for (const VkExtensionProperties& extension : properties) {
        names.emplace_back(extension.extensionName);
    }
    return names;
}

std::vector<VkQueueFamilyProperties> queue_families(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    return families;
}

std::uint32_t compute_queue_family(VkPhysicalDevice physical) {
    const std::vector<VkQueueFamilyProperties> families = queue_families(physical);
    std::uint32_t found = UINT32_MAX;
    for (std::uint32_t i = 0; i < families.size(); ++i) {
        const bool computes = families[i].queueFlags & VK_QUEUE_COMPUTE_BIT;
        const bool draws = families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT;
        if (computes && (found == UINT32_MAX || draws)) {
            found = i;
            if (draws) {
                break;
            }
        }
    }
    return found;
}

namespace {

DeviceKind kind_of(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return DeviceKind::discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return DeviceKind::integrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return DeviceKind::virtual_gpu;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return DeviceKind::cpu;
    default:
        return DeviceKind::other;
    }
}

/// Whether a device of Vulkan 1.2 draws as VulkanRaster does.
bool can_draw(VkPhysicalDevice physical, const VkPhysicalDeviceLimits& limits) {
    constexpr std::uint32_t buffers_and_output = 16; // of a fragment shader
    const std::vector<VkQueueFamilyProperties> families = queue_families(physical);
    const std::uint32_t family = compute_queue_family(physical);
    VkPhysicalDeviceVulkan12Features features{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceFeatures2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    all.pNext = &features;
    vkGetPhysicalDeviceFeatures2(physical, &all);
    VkFormatProperties depth;
    vkGetPhysicalDeviceFormatProperties(physical, depth_format, &depth);
    return family < families.size() && (families[family].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0 &&
           features.shaderOutputLayer == VK_TRUE &&
           limits.maxFragmentCombinedOutputResources >= buffers_and_output &&
           (depth.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
}

std::uint64_t largest_local_heap(VkPhysicalDevice physical) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    std::uint64_t largest = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) {
            largest = std::max<std::uint64_t>(largest, memory.memoryHeaps[i].size);
        }
    }
    return largest;
}

} // namespace

DeviceInfo describe(VkPhysicalDevice physical, std::uint32_t index) {
    VkPhysicalDeviceSubgroupProperties subgroup{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &subgroup;
    VkPhysicalDeviceProperties basic;
    vkGetPhysicalDeviceProperties(physical, &basic);
    if (basic.apiVersion >= VK_API_VERSION_1_2) {
        subgroup.pNext = &driver;
    }
    if (basic.apiVersion >= VK_API_VERSION_1_1) {
        vkGetPhysicalDeviceProperties2(physical, &properties);
    }

    DeviceInfo info;
    info.backend = "vulkan";
    info.index = index;
    info.name = basic.deviceName;
    info.driver = fmt::format("{} {}", driver.driverName, driver.driverInfo);
    info.api_version =
        fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(basic.apiVersion),
                    VK_API_VERSION_MINOR(basic.apiVersion), VK_API_VERSION_PATCH(basic.apiVersion));
    info.kind = kind_of(basic.deviceType);
    info.subgroup_size = std::max(subgroup.subgroupSize, 1u);

    constexpr VkSubgroupFeatureFlags needed = VK_SUBGROUP_FEATURE_ARITHMETIC_BIT |
                                              VK_SUBGROUP_FEATURE_BALLOT_BIT |
                                              VK_SUBGROUP_FEATURE_SHUFFLE_BIT;
    const std::vector<std::string> extensions = device_extensions(physical);
    info.features.subgroups = (subgroup.supportedOperations & needed) == needed &&
                              (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT);
    info.features.push_descriptors =
        std::find(extensions.begin(), extensions.end(), VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME) !=
        extensions.end();
    info.features.timestamps = basic.limits.timestampComputeAndGraphics;
    info.features.lane_serial = info.kind == DeviceKind::cpu;
    info.features.raster =
        basic.apiVersion >= VK_API_VERSION_1_2 && can_draw(physical, basic.limits);

    info.limits.storage_range = basic.limits.maxStorageBufferRange;
    info.limits.memory = largest_local_heap(physical);
    info.limits.invocations = std::min(basic.limits.maxComputeWorkGroupInvocations,
                                       basic.limits.maxComputeWorkGroupSize[0]);
    info.limits.shared_memory = basic.limits.maxComputeSharedMemorySize;
    info.limits.storage_buffers = std::min(basic.limits.maxPerStageDescriptorStorageBuffers,
                                           basic.limits.maxDescriptorSetStorageBuffers);
    info.limits.texels = basic.limits.maxTexelBufferElements;
    info.limits.image =
        std::min({basic.limits.maxImageDimension2D, basic.limits.maxFramebufferWidth,
                  basic.limits.maxFramebufferHeight});
    info.limits.layers =
        std::min(basic.limits.maxImageArrayLayers, basic.limits.maxFramebufferLayers);
    info.limits.groups = std::min({basic.limits.maxComputeWorkGroupCount[0],
                                   basic.limits.maxComputeWorkGroupCount[1],
                                   basic.limits.maxComputeWorkGroupCount[2]});

    if (basic.apiVersion < VK_API_VERSION_1_2) {
        info.unsuitable = fmt::format("it supports Vulkan {}, Argand needs 1.2", info.api_version);
    } else if (compute_queue_family(physical) == UINT32_MAX) {
        info.unsuitable = "it has no queue for compute";
    } else {
        info.unsuitable = unmet_requirement(info.limits);
    }
    return info;
}

} // namespace argand::vulkan
