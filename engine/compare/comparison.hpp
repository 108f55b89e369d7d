#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace argand {

/// Differences between two backends' results of one stage, over all its runs.
struct StageComparison {
    std::string name; ///< of the kernel or primitive
    std::uint64_t runs = 0;
    std::uint64_t items = 0;    ///< records that the stage may have written
    std::uint64_t unequal = 0;  ///< items that differ in any bit
    std::uint64_t diverged = 0; ///< items that differ by more than the tolerance, or in an integer
    std::uint64_t largest_ulp = 0; ///< between floats of items that did not diverge
    double largest_relative = 0;   ///< the same, relative to the larger one
    double seconds_a = 0;
    double seconds_b = 0;
};

/// Compares the items of two buffers and adds the differences to `result`. `layout` has a character
/// for each word of an item: 'f' for a float, 'u' for anything else. Floats diverge if they differ
/// by more than `tolerance` relative to the larger one, or to a thousandth of the largest value
/// that the same word has in any item: a component of a direction may be almost 0.
void compare_items(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b,
                   std::string_view layout, double tolerance, StageComparison& result);

} // namespace argand
