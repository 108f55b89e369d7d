#include "backend_options.hpp"

#include "base/environment.hpp"

#include <fmt/format.h>

namespace argand {

void add_backend_options(CLI::App& command, std::string& backend, std::string& device) {
    command
        .add_option("--backend", backend, fmt::format("auto, {}", fmt::join(backend_names(), ", ")))
        ->capture_default_str();
    command.add_option("--device", device,
                       "Device by index or part of its name (see `argand devices`)");
}

std::unique_ptr<Device> open_backend(const std::string& backend, const std::string& device,
                                     bool quiet) {
    if (backend != "auto") {
        return open_device(device, backend);
    }
    std::unique_ptr<Device> opened;
    try {
        opened = open_device(device);
    } catch (const DeviceFault& fault) {
        return open_after_fault(backend, device, fault);
    }
    const bool told = quiet || !device.empty() || !environment("ARGAND_BACKEND").empty();
    const std::string missing = told ? "" : why_missing(backend_names().front());
    if (!missing.empty()) {
        fmt::print(stderr, "argand: note: using backend {} ({}): {}\n", opened->info().backend,
                   opened->info().name, missing);
    }
    return opened;
}

std::unique_ptr<Device> open_after_fault(const std::string& backend, const std::string& device,
                                         const DeviceFault& fault) {
    if (backend != "auto" || !device.empty()) {
        throw fault;
    }
    const std::string other =
        fault.backend != "vulkan" && why_missing("vulkan").empty() ? "vulkan" : "cpu";
    fmt::print(stderr, "argand: note: {}; continuing with backend {}\n", fault.what(), other);
    return open_device("", other);
}

} // namespace argand
