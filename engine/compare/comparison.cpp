#include "compare/comparison.hpp"

#include "device/device.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace argand {

namespace {

/// Numbers floats in their order: neighbours differ by 1, and both zeros share a number.
std::int64_t ordinal(std::uint32_t bits) {
    const auto magnitude = static_cast<std::int64_t>(bits & 0x7fffffffu);
    return (bits >> 31) != 0 ? -magnitude : magnitude;
}

struct Difference {
    std::uint64_t ulp = 0;
    double relative = 0;
    bool diverged = false;
};

/// For each word of an item, the largest finite float over all items.
std::vector<double> largest_floats(std::span<const std::uint32_t> words, std::string_view layout) {
    std::vector<double> largest(layout.size(), 0.0);
    for (std::size_t i = 0; i < words.size(); ++i) {
        const double value = std::abs(std::bit_cast<float>(words[i]));
        if (words[i] != undefined_word && std::isfinite(value)) {
            largest[i % layout.size()] = std::max(largest[i % layout.size()], value);
        }
    }
    return largest;
}

Difference difference(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b,
                      std::string_view layout, std::span<const double> largest, double tolerance) {
    Difference worst;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) {
            continue;
        }
        const double x = std::bit_cast<float>(a[i]);
        const double y = std::bit_cast<float>(b[i]);
        if (layout[i] != 'f' || !std::isfinite(x) || !std::isfinite(y)) {
            worst.diverged =
                worst.diverged || layout[i] != 'f' || !(std::isnan(x) && std::isnan(y));
            continue;
        }
        const double relative =
            x == y ? 0 : std::abs(x - y) / std::max({std::abs(x), std::abs(y), 1e-3 * largest[i]});
        worst.diverged = worst.diverged || relative > tolerance;
        worst.relative = std::max(worst.relative, relative);
        worst.ulp = std::max(worst.ulp,
                             static_cast<std::uint64_t>(std::abs(ordinal(a[i]) - ordinal(b[i]))));
    }
    return worst;
}

/// Both zeros are equal.
bool same_value(std::uint32_t a, std::uint32_t b, char kind) {
    return a == b || (kind == 'f' && ((a | b) & 0x7fffffffu) == 0);
}

} // namespace

void compare_items(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b,
                   std::string_view layout, double tolerance, StageComparison& result) {
    const std::vector<double> largest = largest_floats(a, layout);
    const std::size_t count = std::min(a.size(), b.size()) / layout.size();
    result.items += count;
    for (std::size_t i = 0; i < count; ++i) {
        const auto item_a = a.subspan(i * layout.size(), layout.size());
        const auto item_b = b.subspan(i * layout.size(), layout.size());
        bool same = true;
        for (std::size_t word = 0; same && word < layout.size(); ++word) {
            same = same_value(item_a[word], item_b[word], layout[word]);
        }
        if (same) {
            continue;
        }
        ++result.unequal;
        const Difference found = difference(item_a, item_b, layout, largest, tolerance);
        if (found.diverged) {
            ++result.diverged;
            continue;
        }
        result.largest_ulp = std::max(result.largest_ulp, found.ulp);
        result.largest_relative = std::max(result.largest_relative, found.relative);
    }
}

} // namespace argand
