#include "base/environment.hpp"
#include "base/error.hpp"
#include "device/device.hpp"
#include "device/vulkan/instance.hpp"
#include "device/vulkan/vulkan_device.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace argand {

namespace {

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Position of the chosen device in the list.
std::size_t choose(const std::vector<DeviceInfo>& devices, const std::string& choice) {
    if (choice.empty()) {
        const auto best = std::min_element(devices.begin(), devices.end(), [](const DeviceInfo& a, const DeviceInfo& b) {
            return std::pair(!a.unsuitable.empty(), a.kind) < std::pair(!b.unsuitable.empty(), b.kind);
        });
        return static_cast<std::size_t>(best - devices.begin());
    }
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
    if (error == std::errc() && end == choice.data() + choice.size()) {
        if (index >= devices.size()) {
            fail("opening device {}: there are {}; `argand devices` lists them", choice, devices.size());
        }
        return index;
    }
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (lower_case(devices[i].name).find(lower_case(choice)) != std::string::npos) {
            return i;
        }
    }
    fail("opening device '{}': no device has that in its name; `argand devices` lists them", choice);
}

} // namespace

std::vector<DeviceInfo> list_devices() {
    const std::shared_ptr<vulkan::Instance> instance = vulkan::instance();
    std::vector<DeviceInfo> devices;
    for (const VkPhysicalDevice physical : instance->physical_devices()) {
        devices.push_back(vulkan::describe(physical, static_cast<std::uint32_t>(devices.size())));
    }
    return devices;
}

std::unique_ptr<Device> open_device(const std::string& choice) {
    const std::shared_ptr<vulkan::Instance> instance = vulkan::instance();
    std::vector<DeviceInfo> devices = list_devices();
    if (devices.empty()) {
        fail("opening a device: Vulkan offers none; install a driver, for instance mesa-vulkan-drivers");
    }
    DeviceInfo info = devices[choose(devices, choice.empty() ? environment("ARGAND_DEVICE") : choice)];
    apply_environment(info);
    if (info.unsuitable.empty()) {
        info.unsuitable = unmet_requirement(info.limits);
    }
    if (!info.unsuitable.empty()) {
        fail("opening device '{}': {}; choose another with --device (`argand devices` lists them)", info.name,
             info.unsuitable);
    }
    const VkPhysicalDevice physical = instance->physical_devices()[info.index];
    return std::make_unique<vulkan::VulkanDevice>(instance, physical, std::move(info));
}

} // namespace argand
