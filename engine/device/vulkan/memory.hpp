#pragma once

#include "device/device_memory.hpp"
#include "device/vulkan/instance.hpp"

#include <map>
#include <memory>
#include <string>
#include <volk.h>

namespace argand::vulkan {

/// Owns the VkDevice. Buffers share it, so they may outlive the Device that allocated them.
struct LogicalDevice {
    std::shared_ptr<Instance> instance;
    VkDevice handle = VK_NULL_HANDLE;

    ~LogicalDevice();
};

enum class MemoryKind : std::uint8_t { device, upload, download };

/// A VkBuffer with memory of its own.
struct VulkanBlock final : MemoryBlock {
    std::shared_ptr<LogicalDevice> device;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr; ///< upload and download blocks only

    ~VulkanBlock() override;

    /// A view of a range as rgba32ui texels, created on first use.
    VkBufferView texels(std::uint64_t offset, std::uint64_t bytes);
    /// Keeps the views for the next buffer only if it is as large as the last one.
    void prepare(std::uint64_t bytes_in_use);

private:
    void destroy_views();

    std::map<std::pair<std::uint64_t, std::uint64_t>, VkBufferView> views_; ///< by offset and size
    std::uint64_t bytes_in_use_ = 0;
};

/// Index of a memory type with the required and, if possible, the preferred properties; UINT32_MAX
/// if there is none.
std::uint32_t memory_type(VkPhysicalDevice physical, std::uint32_t allowed,
                          VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred);

/// Null if memory has run out.
std::unique_ptr<MemoryBlock> allocate_block(VkPhysicalDevice physical,
                                            const std::shared_ptr<LogicalDevice>& device,
                                            std::uint64_t bytes, MemoryKind kind);

} // namespace argand::vulkan
