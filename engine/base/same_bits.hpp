#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace argand {

/// Whether records of 32-bit words have the same bits.
template <class Record> bool have_same_bits(const Record& a, const Record& b) {
    using Words = std::array<std::uint32_t, sizeof(Record) / sizeof(std::uint32_t)>;
    return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

} // namespace argand
