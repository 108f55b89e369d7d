#define VOLK_IMPLEMENTATION
#include "device/vulkan/instance.hpp"

#include "base/environment.hpp"
#include "base/error.hpp"
#include "device/validation.hpp"
#include "device/vulkan/result.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace argand::vulkan {

namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

bool wants_validation() {
    const std::string wanted = environment("ARGAND_VALIDATION");
#ifdef NDEBUG
    return wanted == "1";
#else
    return wanted != "0";
#endif
}

bool has_layer(const char* name) {
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(), [&](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, name) == 0;
    });
}

bool has_instance_extension(const char* name) {
    std::uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const VkExtensionProperties& extension) {
                           return std::strcmp(extension.extensionName, name) == 0;
                       });
}

/// Messages of the whole process. An instance may report messages until it is destroyed, and a
/// process may create several in turn.
ValidationLog& process_log() {
    static ValidationLog log;
    return log;
}

bool surfaces_wanted = false;

/// Adds those for the displays that there may be. Drivers complain about Wayland where it does not
/// run.
void add_surface_extensions(std::vector<const char*>& extensions) {
    for (const char* extension : {"VK_KHR_surface", "VK_KHR_xcb_surface", "VK_KHR_xlib_surface",
                                  "VK_KHR_wayland_surface"}) {
        const bool is_absent = extension == std::string_view("VK_KHR_wayland_surface") &&
                               environment("WAYLAND_DISPLAY").empty();
        if (!is_absent && has_instance_extension(extension)) {
            extensions.push_back(extension);
        }
    }
}

void append(ValidationLog& log, const char* message) {
    const std::lock_guard lock(log.mutex);
    log.messages.emplace_back(message);
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* log) {
    append(*static_cast<ValidationLog*>(log), data->pMessage);
    append(process_log(), data->pMessage);
    return VK_FALSE;
}

} // namespace

Instance::Instance() {
    if (const std::filesystem::path cache = cache_directory(); !cache.empty()) {
        // Mesa has its own cache of compiled shaders. Keeping it beside ours makes both easy to
        // find and clear.
        std::error_code unwritable; // then Mesa caches nothing
        std::filesystem::create_directories(cache, unwritable);
        set_default_environment("MESA_SHADER_CACHE_DIR", (cache / "mesa").string());
    }
    if (volkInitialize() != VK_SUCCESS) {
        fail("starting Vulkan: no Vulkan loader was found; install libvulkan1 and a driver, for "
             "instance mesa-vulkan-drivers");
    }
    if (volkGetInstanceVersion() < VK_API_VERSION_1_2) {
        fail("starting Vulkan: the loader supports Vulkan 1.{}, Argand needs 1.2; update it",
             VK_API_VERSION_MINOR(volkGetInstanceVersion()));
    }

    std::vector<const char*> layers;
    std::vector<const char*> extensions;
    VkDebugUtilsMessengerCreateInfoEXT messenger{
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                            VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = on_message;
    messenger.pUserData = &validation_;
    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;
    features.pNext = &messenger;

    const bool validate = wants_validation() && has_layer(validation_layer);
    if (validate) {
        layers.push_back(validation_layer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    } else if (environment("ARGAND_VALIDATION") == "1") {
        fail("starting Vulkan: ARGAND_VALIDATION=1, but the validation layers are missing; install "
             "vulkan-validationlayers");
    }
    const bool portability = has_instance_extension(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    if (portability) {
        extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    }

    if (surfaces_wanted) {
        add_surface_extensions(extensions);
    }

    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "argand";
    application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo create{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    create.pNext = validate ? &features : nullptr;
    create.flags = portability ? VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR : 0;
    create.pApplicationInfo = &application;
    create.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    create.ppEnabledLayerNames = layers.data();
    create.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    create.ppEnabledExtensionNames = extensions.data();
    check(vkCreateInstance(&create, nullptr, &instance_), "starting Vulkan");
    volkLoadInstance(instance_);
    if (validate) {
        messenger.pNext = nullptr;
        check(vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_),
              "starting validation");
    }
}

Instance::~Instance() {
    if (messenger_) {
        vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    }
    if (instance_) {
        vkDestroyInstance(instance_, nullptr);
    }
}

std::vector<VkPhysicalDevice> Instance::physical_devices() const {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "listing Vulkan devices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance_, &count, devices.data()), "listing Vulkan devices");
    return devices;
}

void want_surfaces() { surfaces_wanted = true; }

std::shared_ptr<Instance> instance() {
    static std::mutex mutex;
    static std::weak_ptr<Instance> shared;
    const std::lock_guard lock(mutex);
    std::shared_ptr<Instance> current = shared.lock();
    if (!current) {
        current = std::make_shared<Instance>();
        shared = current;
    }
    return current;
}

} // namespace argand::vulkan

namespace argand {

std::vector<std::string> all_validation_messages() {
    vulkan::ValidationLog& log = vulkan::process_log();
    const std::lock_guard lock(log.mutex);
    return log.messages;
}

} // namespace argand
