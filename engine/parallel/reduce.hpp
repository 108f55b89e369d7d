#pragma once

#include "device/count.hpp"
#include "device/device.hpp"

namespace argand {

/// Writes the sum, minimum or maximum of `in` to out[out_index]; 0, 0xffffffff and 0 for no
/// element. Records only.
void reduce_sum(Device& device, const Buffer& in, const Buffer& out, std::uint32_t out_index,
                const Count& count);
void reduce_min(Device& device, const Buffer& in, const Buffer& out, std::uint32_t out_index,
                const Count& count);
void reduce_max(Device& device, const Buffer& in, const Buffer& out, std::uint32_t out_index,
                const Count& count);

/// Bounding box of boxes (see BoxRecord) to out[out_index]; low > high for no element.
void reduce_box(Device& device, const Buffer& boxes, const Buffer& out, std::uint32_t out_index,
                const Count& count);

} // namespace argand
