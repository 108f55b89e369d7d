#include "device/vulkan/memory.hpp"

#include "base/error.hpp"
#include "device/vulkan/result.hpp"

#include <algorithm>

namespace argand::vulkan {

std::uint32_t memory_type(VkPhysicalDevice physical, std::uint32_t allowed,
                          VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred) {
    VkPhysicalDeviceMemoryProperties properties;
    vkGetPhysicalDeviceMemoryProperties(physical, &properties);
    for (const VkMemoryPropertyFlags flags : {required | preferred, required}) {
        for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
            if ((allowed & (1u << i)) &&
                (properties.memoryTypes[i].propertyFlags & flags) == flags) {
                return i;
            }
        }
    }
    return UINT32_MAX;
}

LogicalDevice::~LogicalDevice() {
    if (handle) {
        vkDestroyDevice(handle, nullptr);
    }
}

VulkanBlock::~VulkanBlock() {
    destroy_views();
    vkDestroyBuffer(device->handle, buffer, nullptr);
    vkFreeMemory(device->handle, memory, nullptr);
}

void VulkanBlock::destroy_views() {
    for (const auto& [range, view] : views_) {
        vkDestroyBufferView(device->handle, view, nullptr);
    }
    views_.clear();
}

void VulkanBlock::prepare(std::uint64_t bytes_in_use) {
    if (bytes_in_use != bytes_in_use_) {
        destroy_views();
        bytes_in_use_ = bytes_in_use;
    }
}

VkBufferView VulkanBlock::texels(std::uint64_t offset, std::uint64_t range) {
    VkBufferView& view = views_[{offset, range}];
    if (!view) {
        VkBufferViewCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
        create.buffer = buffer;
        // Every device supports this format for uniform texel buffers.
        create.format = VK_FORMAT_R32G32B32A32_UINT;
        create.offset = offset;
        create.range = range / 16 * 16;
        check(vkCreateBufferView(device->handle, &create, nullptr, &view),
              "creating a view of a buffer");
    }
    return view;
}

std::unique_ptr<MemoryBlock> allocate_block(VkPhysicalDevice physical,
                                            const std::shared_ptr<LogicalDevice>& device,
                                            std::uint64_t bytes, MemoryKind kind) {
    auto block = std::make_unique<VulkanBlock>();
    block->device = device;
    block->bytes = bytes;

    VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    create.size = bytes;
    create.usage = kind == MemoryKind::device
                       ? VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                             VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT
                       : VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    check(vkCreateBuffer(device->handle, &create, nullptr, &block->buffer), "creating a buffer");

    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device->handle, block->buffer, &requirements);
    constexpr VkMemoryPropertyFlags host =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const std::uint32_t type =
        kind == MemoryKind::device
            ? memory_type(physical, requirements.memoryTypeBits, 0,
                          VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)
            : memory_type(physical, requirements.memoryTypeBits, host,
                          kind == MemoryKind::download ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT : 0);
    if (type == UINT32_MAX) {
        fail("allocating {} bytes: the device has no memory of the kind needed; try another with "
             "--device",
             bytes);
    }
    VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocate.allocationSize = requirements.size;
    allocate.memoryTypeIndex = type;
    const VkResult result = vkAllocateMemory(device->handle, &allocate, nullptr, &block->memory);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY ||
        result == VK_ERROR_TOO_MANY_OBJECTS) {
        return nullptr;
    }
    check(result, "allocating memory");
    check(vkBindBufferMemory(device->handle, block->buffer, block->memory, 0), "binding memory");
    if (kind != MemoryKind::device) {
        void* mapped = nullptr;
        check(vkMapMemory(device->handle, block->memory, 0, VK_WHOLE_SIZE, 0, &mapped),
              "mapping memory");
        block->mapped = static_cast<std::byte*>(mapped);
    }
    return block;
}

} // namespace argand::vulkan
