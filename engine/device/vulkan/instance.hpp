#pragma once

#include "device/info.hpp"

#include <memory>
#include <mutex>
#include <string>
#include <vector>
#include <volk.h>

namespace argand::vulkan {

/// Messages of the validation layers. The debug callback appends to it.
struct ValidationLog {
    std::mutex mutex;
    std::vector<std::string> messages;
};

/// The Vulkan loader, an instance, and validation if it is on. Shared by all devices of the
/// process.
class Instance {
public:
    /// Throws Error if the system has no Vulkan loader or no Vulkan 1.2.
    Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    ~Instance();

    VkInstance handle() const { return instance_; }
    ValidationLog& validation() { return validation_; }
    std::vector<VkPhysicalDevice> physical_devices() const;

private:
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    ValidationLog validation_;
};

/// Lets instances that are made from now on draw on windows.
void want_surfaces();

/// The process's instance, created at the first call and destroyed with its last user.
std::shared_ptr<Instance> instance();

/// Describes a physical device, before the environment's restrictions are applied.
DeviceInfo describe(VkPhysicalDevice physical, std::uint32_t index);

/// Names of the extensions that a physical device offers.
std::vector<std::string> device_extensions(VkPhysicalDevice physical);

/// The device's queue families, in the order of their indices.
std::vector<VkQueueFamilyProperties> queue_families(VkPhysicalDevice physical);

/// Index of the queue family for compute; UINT32_MAX if there is none. Prefers a family that also
/// supports graphics, because the queues of others can be slower to start.
std::uint32_t compute_queue_family(VkPhysicalDevice physical);

} // namespace argand::vulkan
