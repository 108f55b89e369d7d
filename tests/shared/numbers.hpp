#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <random>

namespace argand::testing {

/// Error of `value` in units in the last place of the truth at single precision; below the normal
/// numbers, in units of the smallest subnormal. 0 if both are the same infinity or NaN.
inline double ulps(float value, double truth) {
    if (std::isnan(truth) || std::isnan(value)) {
        return std::isnan(truth) && std::isnan(value) ? 0 : std::numeric_limits<double>::infinity();
    }
    const auto rounded = static_cast<float>(truth);
    if (std::isinf(rounded) || std::isinf(value)) {
        return rounded == value ? 0 : std::numeric_limits<double>::infinity();
    }
    int exponent = 0;
    std::frexp(truth, &exponent); // truth = m 2^exponent, m in [1/2, 1)
    const double unit = std::ldexp(1.0, std::max(exponent, -125) - 24);
    return std::abs(double(value) - truth) / unit;
}

/// Rounds to single precision, through memory: GCC 12's vectoriser converts pairs of numbers from
/// double to float and back without rounding them.
inline glm::vec3 rounded(glm::dvec3 v) {
    volatile float x = static_cast<float>(v.x);
    volatile float y = static_cast<float>(v.y);
    volatile float z = static_cast<float>(v.z);
    return {x, y, z};
}

/// A finite number with uniform bits: all magnitudes, both signs.
inline float any_finite(std::mt19937& bits) {
    while (true) {
        const auto x = std::bit_cast<float>(static_cast<std::uint32_t>(bits()));
        if (std::isfinite(x)) {
            return x;
        }
    }
}

/// A number between 2^low and 2^high, uniform in its logarithm.
inline float any_magnitude(std::mt19937& bits, int low, int high) {
    return static_cast<float>(std::exp2(std::uniform_real_distribution<double>(low, high)(bits)));
}

} // namespace argand::testing
