#include "base/environment.hpp"
#include "base/error.hpp"
#include "device/device.hpp"
#include "device/host/host_device.hpp"
#if ARGAND_CUDA
#include "device/cuda/cuda_device.hpp"
#endif
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

/// All devices, and for each backend without a device the reason.
struct DeviceList {
    std::vector<DeviceInfo> devices;
    std::map<std::string, std::string> missing;
    std::size_t first_cuda = 0; ///< index of the first CUDA device; Vulkan's devices come first
};

DeviceList find_devices() {
    DeviceList result;
    const auto add = [&](std::vector<DeviceInfo> devices) {
        for (DeviceInfo& device : devices) {
            device.index = static_cast<std::uint32_t>(result.devices.size());
            result.devices.push_back(std::move(device));
        }
    };
    try {
        add(vulkan::list_devices());
        if (result.devices.empty()) {
            result.missing["vulkan"] =
                "Vulkan offers no device; install a driver, for instance mesa-vulkan-drivers";
        }
    } catch (const Error& error) {
        result.missing["vulkan"] = error.what();
    }
#if ARGAND_CUDA
    result.first_cuda = result.devices.size();
    add(cuda::list_devices(result.missing["cuda"]));
#endif
    add({host::describe()});
    return result;
}

/// The chosen device among those of a backend; of all backends if `backend` is empty.
const DeviceInfo& choose(const DeviceList& list, const std::string& choice,
                         const std::string& backend) {
    std::vector<const DeviceInfo*> devices;
    for (const DeviceInfo& device : list.devices) {
        if (backend.empty() || device.backend == backend) {
            devices.push_back(&device);
        }
    }
    if (devices.empty()) {
        fail("opening a device of backend {}: {}; or try another backend, as `argand devices` "
             "lists them",
             backend, list.missing.at(backend));
    }
    if (choice.empty()) {
        const std::vector<std::string>& order = backend_names();
        const auto rank = [&](const DeviceInfo& device) {
            return std::tuple(!device.unsuitable.empty(), device.kind == DeviceKind::cpu,
                              std::find(order.begin(), order.end(), device.backend) - order.begin(),
                              device.kind);
        };
        return **std::min_element(
            devices.begin(), devices.end(),
            [&](const DeviceInfo* a, const DeviceInfo* b) { return rank(*a) < rank(*b); });
    }
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
    const bool is_index = error == std::errc() && end == choice.data() + choice.size();
    for (const DeviceInfo* device : devices) {
        if (is_index ? device->index == index
                     : lower_case(device->name).find(lower_case(choice)) != std::string::npos) {
            return *device;
        }
    }
    fail("opening device '{}': there is none of that {}{}; `argand devices` lists them", choice,
         is_index ? "index" : "name", backend.empty() ? "" : " of backend " + backend);
}

} // namespace

const std::vector<std::string>& backend_names() {
#if ARGAND_CUDA
    static const std::vector<std::string> names{"vulkan", "cuda", "cpu"};
#else
    static const std::vector<std::string> names{"vulkan", "cpu"};
#endif
    return names;
}

std::string why_missing(const std::string& backend) {
    const DeviceList list = find_devices();
    const auto found = list.missing.find(backend);
    return found == list.missing.end() ? "" : found->second;
}

std::vector<DeviceInfo> list_devices() { return find_devices().devices; }

std::unique_ptr<Device> open_device(const std::string& choice, const std::string& backend) {
    const std::string chosen_backend = backend.empty() ? environment("ARGAND_BACKEND") : backend;
    const std::vector<std::string>& names = backend_names();
    if (!chosen_backend.empty() &&
        std::find(names.begin(), names.end(), chosen_backend) == names.end()) {
        throw UsageError(fmt::format("choosing backend '{}': this build has {}", chosen_backend,
                                     fmt::join(names, ", ")));
    }
    const DeviceList list = find_devices();
    // A caller who names a backend gets no device from the environment, which may name one of
    // another backend.
    const bool from_environment = choice.empty() && backend.empty();
    DeviceInfo info =
        choose(list, from_environment ? environment("ARGAND_DEVICE") : choice, chosen_backend);
    apply_environment(info);
    if (info.unsuitable.empty()) {
        info.unsuitable = unmet_requirement(info.limits);
    }
    if (!info.unsuitable.empty()) {
        fail("opening device '{}': {}; choose another with --device (`argand devices` lists them)",
             info.name, info.unsuitable);
    }
    if (info.backend == "cpu") {
        return std::make_unique<host::HostDevice>(std::move(info));
    }
#if ARGAND_CUDA
    if (info.backend == "cuda") {
        const auto ordinal = static_cast<int>(info.index - list.first_cuda);
        return cuda::open(std::move(info), ordinal);
    }
#endif
    return vulkan::open(std::move(info));
}

} // namespace argand
