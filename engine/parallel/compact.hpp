#pragma once

#include "device/count.hpp"
#include "device/device.hpp"

namespace argand {

/// Writes the values[i] whose flags[i] is not 0 to `out`, in their order, and their number to
/// counts[count_index]. `values` and `out` are different buffers; `counts` may be the buffer that
/// the count is read from, at another index. Records only.
void compact(Device& device, const Buffer& flags, const Buffer& values, const Buffer& out,
             const Buffer& counts, std::uint32_t count_index, const Count& count);

} // namespace argand
