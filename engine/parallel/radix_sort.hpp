#pragma once

#include "device/count.hpp"
#include "device/device.hpp"

namespace argand {

/// Sorts 32-bit keys (uint) in place, ascending and stable, by their lowest `bits` bits. Records
/// only.
void radix_sort(Device& device, const Buffer& keys, const Count& count, std::uint32_t bits = 32);
/// The same, with a 32-bit value beside each key.
void radix_sort_pairs(Device& device, const Buffer& keys, const Buffer& values, const Count& count,
                      std::uint32_t bits = 32);
/// The same for 64-bit keys (uvec2: low and high word) with 32-bit values.
void radix_sort_pairs64(Device& device, const Buffer& keys, const Buffer& values,
                        const Count& count, std::uint32_t bits = 64);

} // namespace argand
