#pragma once

#include "device/buffer.hpp"
#include "device/memory_ledger.hpp"
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

struct VulkanBuffer final : BufferStorage {
    std::shared_ptr<LogicalDevice> device;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr; ///< upload and download buffers only
    std::uint64_t allocated = 0; ///< bytes counted in the ledger
    std::shared_ptr<MemoryLedger> ledger;
    std::map<std::pair<std::uint64_t, std::uint64_t>, VkBufferView> views; ///< by offset and size

    ~VulkanBuffer() override;

    /// A view of a range as rgba32ui texels, created on first use.
    VkBufferView texels(std::uint64_t offset, std::uint64_t bytes);
};

/// Throws Error if the device lacks the memory.
std::shared_ptr<VulkanBuffer> allocate_buffer(VkPhysicalDevice physical,
                                              const std::shared_ptr<LogicalDevice>& device,
                                              const std::shared_ptr<MemoryLedger>& ledger,
                                              std::string name, std::uint64_t bytes,
                                              MemoryKind kind);

} // namespace argand::vulkan
