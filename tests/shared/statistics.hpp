#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace argand::testing {

/// Excess of Pearson's chi-square of the counts over its expectation, in standard deviations
/// (Wilson and Hilferty 1931). `expected`: expected counts; cells that expect fewer than 5 are
/// pooled.
inline double chi_square_deviations(const std::vector<double>& counts,
                                    const std::vector<double>& expected) {
    double chi_square = 0;
    double pooled_count = 0;
    double pooled_expected = 0;
    double cells = -1;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] < 5) {
            pooled_count += counts[i];
            pooled_expected += expected[i];
            continue;
        }
        chi_square += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
        ++cells;
    }
    if (pooled_expected > 0 || pooled_count > 0) {
        const double at_least = std::max(pooled_expected, 1.0);
        chi_square +=
            (pooled_count - pooled_expected) * (pooled_count - pooled_expected) / at_least;
        ++cells;
    }
    const double spread = 2 / (9 * cells);
    return (std::cbrt(chi_square / cells) - (1 - spread)) / std::sqrt(spread);
}

/// The same for equal expectations.
inline double chi_square_deviations(const std::vector<double>& counts) {
    double sum = 0;
    for (const double count : counts) {
        sum += count;
    }
    return chi_square_deviations(counts,
                                 std::vector<double>(counts.size(), sum / double(counts.size())));
}

/// A correct sampler exceeds this in one of 3 million tests. The tests' random streams are fixed.
inline constexpr double unlikely = 5;

/// Mean of numbers, and the standard deviation of that mean.
struct Mean {
    double sum = 0, squares = 0, count = 0;
    void add(double x) {
        sum += x;
        squares += x * x;
        ++count;
    }
    double value() const { return sum / count; }
    double deviation() const {
        return std::sqrt(std::max(squares / count - value() * value(), 0.0) / count);
    }
};

} // namespace argand::testing
