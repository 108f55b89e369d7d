#pragma once

#include "base/error.hpp"
#include "device/device.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace argand {

/// Adds --backend and --device. Backend "auto", the default, is the first with a suitable device.
void add_backend_options(CLI::App& command, std::string& backend, std::string& device);

/// Opens the device that the user asked for. With "auto", prints a note if the first backend has
/// none, unless `quiet`.
std::unique_ptr<Device> open_backend(const std::string& backend, const std::string& device,
                                     bool quiet);

/// Opens a device of another backend after the fault of one that "auto" chose, and prints a note.
/// Throws the fault again if the user chose the device.
std::unique_ptr<Device> open_after_fault(const std::string& backend, const std::string& device,
                                         const DeviceFault& fault);

} // namespace argand
