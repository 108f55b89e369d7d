#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace argand {

using Elements = std::vector<std::uint32_t>;

/// What buffers hold before a test writes to them.
inline constexpr std::uint32_t untouched = 0xabadcafe;

/// Sizes at which divisions into fours, lanes, tiles and parts have their edges: 0, 1, around
/// powers of two, primes.
inline std::vector<std::uint32_t> sizes() {
    return {0,     1,     2,     3,      4,      5,      7,      8,       9,      31,
            63,    64,    65,    127,    128,    129,    511,    512,     513,    1009,
            2047,  2048,  2049,  4095,   4096,   4097,   8191,   8192,    8193,   16385,
            65535, 65536, 65537, 104729, 131073, 262143, 262145, 1000003, 1048576};
}

inline constexpr std::uint32_t large_size = 10'000'000;

/// More elements than the largest number of groups takes in two tiles each.
inline constexpr std::uint32_t size_beyond_the_groups = 2'200'003;

/// Numbers below `below` (0: any 32 bits), the same for the same arguments.
inline Elements random_elements(std::size_t n, std::uint32_t below = 0, std::uint32_t seed = 1) {
    std::mt19937 random(seed);
    Elements elements(n);
    for (std::uint32_t& element : elements) {
        element = static_cast<std::uint32_t>(random());
        element = below > 0 ? element % below : element;
    }
    return elements;
}

} // namespace argand
