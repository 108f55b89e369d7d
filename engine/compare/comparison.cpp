#include "compare/comparison.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace argand {

namespace {

/// Floats numbered in their order, so that neighbours differ by 1 and both zeros are one number.
std::int64_t ordinal(std::uint32_t bits) {
    const auto magnitude = static_cast<std::int64_t>(bits & 0x7fffffffu);
    return (bits >> 31) != 0 ? -magnitude : magnitude;
}

struct Difference {
    std::uint64_t ulp = 0;
    double relative = 0;
    bool diverged = false;
};

double largest_float(std::span<const std::uint32_t> item, std::string_view layout) {
    double largest = 0;
    for (std::size_t i = 0; i < item.size(); ++i) {
        const double value = std::abs(std::bit_cast<float>(item[i]));
        if (layout[i] == 'f' && std::isfinite(value)) {
            largest = std::max(largest, value);
        }
    }
    return largest;
}

Difference difference(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, std::string_view layout) {
    Difference worst;
    const double least = 1e-3 * std::max(largest_float(a, layout), largest_float(b, layout));
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) {
            continue;
        }
        const double x = std::bit_cast<float>(a[i]);
        const double y = std::bit_cast<float>(b[i]);
        if (layout[i] != 'f' || !std::isfinite(x) || !std::isfinite(y)) {
            worst.diverged = worst.diverged || layout[i] != 'f' || !(std::isnan(x) && std::isnan(y));
            continue;
        }
        const double relative = x == y ? 0 : std::abs(x - y) / std::max({std::abs(x), std::abs(y), least});
        worst.diverged = worst.diverged || relative > divergence_tolerance;
        worst.relative = std::max(worst.relative, relative);
        worst.ulp = std::max(worst.ulp, static_cast<std::uint64_t>(std::abs(ordinal(a[i]) - ordinal(b[i]))));
    }
    return worst;
}

} // namespace

void compare_items(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, std::string_view layout,
                   StageComparison& result) {
    const std::size_t count = std::min(a.size(), b.size()) / layout.size();
    result.items += count;
    for (std::size_t i = 0; i < count; ++i) {
        const auto item_a = a.subspan(i * layout.size(), layout.size());
        const auto item_b = b.subspan(i * layout.size(), layout.size());
        if (std::equal(item_a.begin(), item_a.end(), item_b.begin())) {
            continue;
        }
        ++result.unequal;
        const Difference found = difference(item_a, item_b, layout);
        if (found.diverged) {
            ++result.diverged;
            continue;
        }
        result.largest_ulp = std::max(result.largest_ulp, found.ulp);
        result.largest_relative = std::max(result.largest_relative, found.relative);
    }
}

} // namespace argand
