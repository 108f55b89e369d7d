#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace argand {

/// What two backends made of one stage, over all its runs.
struct StageComparison {
    std::string name; ///< of the kernel or the primitive
    std::uint64_t runs = 0;
    std::uint64_t items = 0;       ///< records that it may have written
    std::uint64_t unequal = 0;     ///< of these, not equal to the bit
    std::uint64_t diverged = 0;    ///< of these, beyond the tolerance, or other in an integer
    std::uint64_t largest_ulp = 0; ///< between floats of items that have not diverged
    double largest_relative = 0;   ///< the same, relative to the larger one
    double seconds_a = 0;
    double seconds_b = 0;
};

/// What is in memory that nothing has been written to.
inline constexpr std::uint32_t undefined_word = 0xcdcdcdcdu;

/// Compares the items of two buffers. `layout`: an item's words, 'f' a float, 'u' any other. Floats
/// have diverged if they are further apart than `tolerance` of the larger one, or of a thousandth
/// of the largest that the same word of any item holds: a direction's component may be as good as
/// 0.
void compare_items(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b,
                   std::string_view layout, double tolerance, StageComparison& result);

} // namespace argand
