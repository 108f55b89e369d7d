#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace argand {

/// `v` scaled to length 1 in double precision, whatever its magnitude; zero if `v` is zero,
/// infinite or NaN.
inline glm::dvec3 unit_or_zero(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    // Well above the smallest normal number, so that v / largest is accurate.
    if (!(largest >= 1e-300) || !std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
        return glm::dvec3(0);
    }
    const glm::dvec3 scaled = v / largest; // its length is between 1 and √3
    return scaled / glm::length(scaled);
}

/// The i-th of `count` directions of even density within a cone about the z axis, by default over
/// the sphere (Fibonacci's spiral).
inline glm::dvec3 spiral_direction(int i, int count, double least_cosine = -1) {
    const double z = 1 - (1 - least_cosine) * (i + 0.5) / count;
    const double turn = 2 * std::numbers::pi * i * (std::numbers::phi - 1);
    const double sine = std::sqrt(1 - z * z);
    return {sine * std::cos(turn), sine * std::sin(turn), z};
}

inline bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool is_finite(const glm::vec3& v) { return is_finite(glm::dvec3(v)); }

} // namespace argand
