#pragma once

#include "device/count.hpp"
#include "device/device.hpp"

namespace argand {

/// Writes the sum (modulo 2^32), minimum or maximum of the uints `in` to out[out_index]; for no
/// element 0, 0xffffffff or 0. Records only.
void reduce_sum(Device& device, const Buffer& in, const Buffer& out, std::uint32_t out_index,
                const Count& count);
void reduce_min(Device& device, const Buffer& in, const Buffer& out, std::uint32_t out_index,
                const Count& count);
void reduce_max(Device& device, const Buffer& in, const Buffer& out, std::uint32_t out_index,
                const Count& count);

/// Writes the bounding box of boxes (BoxRecord) to out[out_index]; low > high for no element.
/// Records only.
void reduce_box(Device& device, const Buffer& boxes, const Buffer& out, std::uint32_t out_index,
                const Count& count);

} // namespace argand
