#pragma once

#include "device/device.hpp"
#include "device/primitives.hpp"

#include <memory>

namespace argand {

class PairedDevice;

/// Sort, scan, reduce and compact on two devices, each with its own implementation.
std::unique_ptr<Primitives> make_paired_primitives(PairedDevice& pair, Device& a, Device& b);

} // namespace argand
