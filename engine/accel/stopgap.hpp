#pragma once

#include "device/count.hpp"
#include "device/device.hpp"

// On the host until engine/parallel has them on the device; they wait for the device.
namespace argand::stopgap {

void radix_sort_pairs(Device& device, const Buffer& keys, const Buffer& values, const Count& count,
                      std::uint32_t bits);
void reduce_box(Device& device, const Buffer& boxes, const Buffer& out, std::uint32_t out_index,
                const Count& count);

} // namespace argand::stopgap
