#pragma once

#include "device/buffer.hpp"

#include <cstdint>

namespace argand {

/// How many elements a stage works on: a number that the host knows, or a uint in a buffer that
/// only the device knows, with the host's upper bound, for which scratch memory is allocated.
struct Count {
    std::uint64_t bound;     ///< the number itself, or its upper bound
    Buffer buffer;           ///< empty: `bound` is the number
    std::uint32_t index = 0; ///< of the uint in `buffer`

    Count(std::uint64_t number) : bound(number) {} // NOLINT(google-explicit-constructor)
    Count(Buffer counts, std::uint32_t at, std::uint64_t upper)
        : bound(upper), buffer(std::move(counts)), index(at) {}
    bool on_device() const { return static_cast<bool>(buffer); }
};

} // namespace argand
