#include "showing_device.hpp"

#include "base/error.hpp"
#include "device/vulkan/memory.hpp"
#include "device/vulkan/result.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace argand::window {

namespace {

using vulkan::check;

/// The first queue family that draws and shows on the surface, or UINT32_MAX.
std::uint32_t showing_family(VkPhysicalDevice physical, VkSurfaceKHR surface) {
    const std::vector<VkQueueFamilyProperties> families = vulkan::queue_families(physical);
    for (std::uint32_t i = 0; i < families.size(); ++i) {
        VkBool32 shows = VK_FALSE;
        vkGetPhysicalDeviceSurfaceSupportKHR(physical, i, surface, &shows);
        if (shows == VK_TRUE && (families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) {
            return i;
        }
    }
    return UINT32_MAX;
}

bool has_swapchains(VkPhysicalDevice physical) {
    const std::vector<std::string> offered = vulkan::device_extensions(physical);
    return std::find(offered.begin(), offered.end(), VK_KHR_SWAPCHAIN_EXTENSION_NAME) !=
           offered.end();
}

} // namespace

ShowingDevice::ShowingDevice(std::shared_ptr<vulkan::Instance> of, VkSurfaceKHR surface)
    : instance(std::move(of)) {
    for (const VkPhysicalDevice candidate : instance->physical_devices()) {
        family = showing_family(candidate, surface);
        if (family != UINT32_MAX && has_swapchains(candidate)) {
            physical = candidate;
            break;
        }
    }
    if (physical == VK_NULL_HANDLE) {
        fail("opening a window: no Vulkan device can draw on this display; use --headless with "
             "--script FILE");
    }
    const float priority = 1;
    VkDeviceQueueCreateInfo queues{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queues.queueFamilyIndex = family;
    queues.queueCount = 1;
    queues.pQueuePriorities = &priority;
    const char* extension = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    VkDeviceCreateInfo create{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queues;
    create.enabledExtensionCount = 1;
    create.ppEnabledExtensionNames = &extension;
    check(vkCreateDevice(physical, &create, nullptr, &device), "opening a window's device");
    vkGetDeviceQueue(device, family, 0, &queue);
}

ShowingDevice::~ShowingDevice() {
    if (device != VK_NULL_HANDLE) {
        vkDeviceWaitIdle(device);
        vkDestroyDevice(device, nullptr);
    }
}

VkDeviceMemory ShowingDevice::allocate(const VkMemoryRequirements& needs,
                                       VkMemoryPropertyFlags properties, const char* what) const {
    VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex =
        vulkan::memory_type(physical, needs.memoryTypeBits, properties, properties);
    if (allocate.memoryTypeIndex == UINT32_MAX) {
        fail("{}: the device has no such memory", what);
    }
    VkDeviceMemory result = VK_NULL_HANDLE;
    check(vkAllocateMemory(device, &allocate, nullptr, &result), what);
    return result;
}

std::byte* HostBuffer::map(VkDeviceSize bytes) {
    if (bytes <= size_) {
        return mapped_;
    }
    release();
    VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    create.size = bytes + bytes / 2;
    create.usage = usage_;
    check(vkCreateBuffer(device_.device, &create, nullptr, &buffer_), "drawing a window");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device_.device, buffer_, &needs);
    memory_ = device_.allocate(
        needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
        "drawing a window");
    check(vkBindBufferMemory(device_.device, buffer_, memory_, 0), "drawing a window");
    void* mapped = nullptr;
    check(vkMapMemory(device_.device, memory_, 0, VK_WHOLE_SIZE, 0, &mapped), "drawing a window");
    mapped_ = static_cast<std::byte*>(mapped);
    size_ = create.size;
    return mapped_;
}

void HostBuffer::release() {
    vkDestroyBuffer(device_.device, buffer_, nullptr);
    vkFreeMemory(device_.device, memory_, nullptr);
    buffer_ = VK_NULL_HANDLE;
    memory_ = VK_NULL_HANDLE;
    mapped_ = nullptr;
    size_ = 0;
}

} // namespace argand::window
