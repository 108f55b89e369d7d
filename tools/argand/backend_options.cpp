#include "backend_options.hpp"

#include <fmt/format.h>

namespace argand {

void add_backend_options(CLI::App& command, std::string& backend, std::string& device) {
    command.add_option("--backend", backend, fmt::format("auto, {}", fmt::join(backend_names(), ", ")))->capture_default_str();
    command.add_option("--device", device, "Device by index or part of its name (see `argand devices`)");
}

std::unique_ptr<Device> open_backend(const std::string& backend, const std::string& device, bool quiet) {
    if (backend != "auto") {
        return open_device(device, backend);
    }
    std::unique_ptr<Device> opened = open_device(device);
    const std::string missing = quiet || !device.empty() ? "" : why_missing(backend_names().front());
    if (!missing.empty()) {
        fmt::print(stderr, "argand: note: using backend {} ({}): {}\n", opened->info().backend, opened->info().name, missing);
    }
    return opened;
}

std::unique_ptr<Device> open_after_fault(const std::string& backend, const std::string& device, const DeviceFault& fault) {
    const std::string other = why_missing("vulkan").empty() ? "vulkan" : "cpu";
    if (backend != "auto" || !device.empty()) {
        throw fault;
    }
    fmt::print(stderr, "argand: note: {}; going on with backend {}\n", fault.what(), other);
    return open_device("", other);
}

} // namespace argand
