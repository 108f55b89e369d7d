#pragma once

#include "device/count.hpp"
#include "device/device.hpp"

namespace argand {

/// out[i] = sum of in[0..i) (exclusive) or in[0..i] (inclusive), of uints modulo 2^32. `in` and
/// `out` may be one buffer. Records only.
void exclusive_scan(Device& device, const Buffer& in, const Buffer& out, const Count& count);
void inclusive_scan(Device& device, const Buffer& in, const Buffer& out, const Count& count);

/// Inclusive sums of uints modulo 2^32 that start anew wherever heads[i] is not 0. `in` and `out`
/// may be one buffer. Records only.
void segmented_scan(Device& device, const Buffer& in, const Buffer& heads, const Buffer& out,
                    const Count& count);

} // namespace argand
