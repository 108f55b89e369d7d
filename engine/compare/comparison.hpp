#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace argand {

/// What two backends made of one stage, over all its runs.
struct StageComparison {
    std::string name;                   ///< of the kernel or the primitive
    std::uint64_t runs = 0;
    std::uint64_t items = 0;            ///< records that it may have written
    std::uint64_t unequal = 0;          ///< of these, not equal to the bit
    std::uint64_t diverged = 0;         ///< of these, beyond the tolerance, or other in an integer
    std::uint64_t largest_ulp = 0;      ///< between floats of items that have not diverged
    double largest_relative = 0;        ///< the same, relative to the larger one
    double seconds_a = 0;
    double seconds_b = 0;
};

/// Floats of one item further apart than this share of the larger one, and of a thousandth of the item's largest, have
/// diverged: a path has taken another way.
inline constexpr double divergence_tolerance = 1e-3;

/// Compares the items of two buffers. `layout`: an item's words, 'f' a float, 'u' any other.
void compare_items(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, std::string_view layout,
                   StageComparison& result);

} // namespace argand
