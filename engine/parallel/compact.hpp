#pragma once

#include "device/count.hpp"
#include "device/device.hpp"

namespace argand {

/// A uint of a buffer. It refers to the buffer.
struct WordAt {
    const Buffer& buffer;
    std::uint32_t index; ///< in uints
};

/// Writes the values[i] (uint) whose flags[i] (uint) is not 0 to `out`, in their order, and their
/// number to `total`. `values` and `out` are different buffers; `total` may lie in the buffer from
/// which the count is read, at another index. Records only.
void compact(Device& device, const Buffer& flags, const Buffer& values, const Buffer& out,
             const WordAt& total, const Count& count);

} // namespace argand
