#pragma once

#include "base/error.hpp"
#include "device/device.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace argand {

/// Adds --backend and --device. Backend "auto", the default: the first that has a suitable device.
void add_backend_options(CLI::App& command, std::string& backend, std::string& device);

/// Opens the device that was asked for. With "auto" a note says so if it is not one of the first
/// backend, unless `quiet`.
std::unique_ptr<Device> open_backend(const std::string& backend, const std::string& device,
                                     bool quiet);

/// After a fault of a device that "auto" had chosen: says so and opens one of another backend.
/// Throws the fault again if the user had chosen, or there is no other.
std::unique_ptr<Device> open_after_fault(const std::string& backend, const std::string& device,
                                         const DeviceFault& fault);

} // namespace argand
