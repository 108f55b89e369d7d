#pragma once

#include "device/buffer.hpp"

#include <cstdint>

namespace argand {

/// Number of elements that a stage processes. Either the host knows it, or only the device does, as
/// a uint in a buffer; then the host gives an upper bound, for which scratch memory is allocated.
struct Count {
    std::uint64_t bound;     ///< the number itself, or its upper bound
    Buffer buffer;           ///< empty: the number is `bound`
    std::uint32_t index = 0; ///< of the uint in `buffer`

    Count(std::uint64_t number) : bound(number) {} // NOLINT(google-explicit-constructor)
    Count(Buffer counts, std::uint32_t at, std::uint64_t upper)
        : bound(upper), buffer(std::move(counts)), index(at) {}
    bool on_device() const { return static_cast<bool>(buffer); }
};

} // namespace argand
