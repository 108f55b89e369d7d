#include "device/vulkan/vulkan_device.hpp"

namespace argand::vulkan {

std::vector<DeviceInfo> list_devices() {
    const std::shared_ptr<Instance> shared = instance();
    std::vector<DeviceInfo> devices;
    for (const VkPhysicalDevice physical : shared->physical_devices()) {
        devices.push_back(describe(physical, static_cast<std::uint32_t>(devices.size())));
    }
    return devices;
}

std::unique_ptr<Device> open(DeviceInfo info) {
    const std::shared_ptr<Instance> shared = instance();
    const VkPhysicalDevice physical = shared->physical_devices()[info.index];
    return std::make_unique<VulkanDevice>(shared, physical, std::move(info));
}

} // namespace argand::vulkan
