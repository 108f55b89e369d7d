#pragma once

#include "device/device.hpp"

namespace argand {

/// Copies `count` elements of `bytes` bytes, if any, between two buffers: from element `first` on
/// to element `place` on. Records only.
inline void copy_elements(Device& device, const Buffer& from, std::uint64_t first, const Buffer& to,
                          std::uint64_t place, std::uint64_t count, std::uint64_t bytes) {
    if (count > 0) { // a view of no bytes would be the whole buffer
        device.copy(BufferView(from, first * bytes, count * bytes),
                    BufferView(to, place * bytes, count * bytes));
    }
}

} // namespace argand
