#pragma once

#include "device/vulkan/instance.hpp"

#include <cstdint>
#include <memory>
#include <volk.h>

namespace argand::window {

/// A Vulkan device that shows pictures on a surface, apart from the one that renders them, which
/// may be of another backend.
struct ShowingDevice {
    std::shared_ptr<vulkan::Instance> instance;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t family = 0; ///< of the queue, for graphics and for showing
    VkQueue queue = VK_NULL_HANDLE;

    /// Throws Error if no device can draw and show on the surface.
    ShowingDevice(std::shared_ptr<vulkan::Instance> of, VkSurfaceKHR surface);
    ShowingDevice(const ShowingDevice&) = delete;
    ShowingDevice& operator=(const ShowingDevice&) = delete;
    ~ShowingDevice();

    /// Allocates memory of these properties. Throws Error if there is none.
    VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties,
                            const char* what) const;
};

/// A buffer that the host writes. It grows, and is not in use while it does.
class HostBuffer {
public:
    HostBuffer(const ShowingDevice& device, VkBufferUsageFlags usage)
        : device_(device), usage_(usage) {}
    HostBuffer(const HostBuffer&) = delete;
    HostBuffer& operator=(const HostBuffer&) = delete;
    ~HostBuffer() { release(); }

    /// Memory of at least so many bytes, with undefined contents.
    std::byte* map(VkDeviceSize bytes);
    VkBuffer handle() const { return buffer_; }

private:
    void release();

    const ShowingDevice& device_;
    VkBufferUsageFlags usage_;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::byte* mapped_ = nullptr;
    VkDeviceSize size_ = 0;
};

} // namespace argand::window
