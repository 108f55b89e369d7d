#include "device/vulkan/result.hpp"

#include "base/error.hpp"

namespace argand::vulkan {

namespace {

const char* in_words(VkResult result) {
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "the machine is out of memory; close other programs or ask for less work";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "the device is out of memory; use fewer photons, a smaller picture or another "
               "device";
    case VK_ERROR_DEVICE_LOST:
        return "the device was lost (a driver fault, or the system ended long work); try again, or "
               "another device with "
               "--device";
    case VK_ERROR_INITIALIZATION_FAILED:
        return "the driver could not be initialised; check its installation";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return "there is no device, as no driver for Vulkan 1.2 was found; install or update one, "
               "for instance the "
               "package mesa-vulkan-drivers";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
        return "the driver lacks an extension it had announced; update it";
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return "the driver lacks a feature it had announced; update it";
    case VK_ERROR_LAYER_NOT_PRESENT:
        return "a Vulkan layer is missing; install the validation layers";
    case VK_ERROR_MEMORY_MAP_FAILED:
        return "memory of the device could not be mapped; close other programs";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
        return "the driver lacks a format that Vulkan requires; update it";
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "the driver has run out of objects; ask for less work";
    default:
        return "the driver reported an unexpected failure; update it, or try another device with "
               "--device";
    }
}

} // namespace

void check(VkResult result, std::string_view doing) {
    if (result == VK_ERROR_DEVICE_LOST) {
        throw DeviceFault("vulkan", fmt::format("{}: {}", doing, in_words(result)));
    }
    if (result < 0) {
        fail("{}: {}", doing, in_words(result));
    }
}

} // namespace argand::vulkan
