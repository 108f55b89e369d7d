#include "commands.hpp"

#include "device/device.hpp"

#include <fmt/format.h>

namespace argand {

namespace {

void list() {
    const std::vector<DeviceInfo> devices = list_devices();
    for (const DeviceInfo& device : devices) {
        fmt::print("{}: {} ({}, {}, backend {}{}, {} MiB){}\n", device.index, device.name,
                   to_string(device.kind), device.driver, device.backend,
                   device.api_version.empty() ? "" : " " + device.api_version,
                   device.limits.memory >> 20,
                   device.unsuitable.empty() ? "" : "; cannot be used: " + device.unsuitable);
    }
    for (const std::string& backend : backend_names()) {
        const std::string missing = why_missing(backend);
        if (!missing.empty()) {
            fmt::print("backend {}: no device, {}\n", backend, missing);
        }
    }
}

} // namespace

void add_devices_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("devices", "List the devices that can render");
    command->footer("Example:\n  argand devices\n\n`argand render --device` takes an index or a "
                    "part of a name.");
    command->callback(list);
}

} // namespace argand
