#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace argand {

/// How values between two keys follow from them (glTF 2.0, appendix C).
enum class Interpolation : std::uint8_t { step, linear, cubic_spline };

/// The keys of one animated value.
struct KeyFrames {
    std::vector<double> times; ///< seconds, rising, at least one
    /// `width` numbers for each key. A key of a cubic spline has three times as many: incoming
    /// tangent, value, outgoing tangent, the tangents per second.
    std::vector<double> values;
    std::size_t width = 1;
    Interpolation interpolation = Interpolation::linear;
};

/// The value at a time, `width` numbers. Before the first key and after the last one it is that
/// key's.
std::vector<double> value_at(const KeyFrames& keys, double seconds);

/// As value_at, for unit quaternions (x, y, z, w) of any length above 0. Linear interpolation is
/// spherical and takes the shorter way. The result has length 1.
glm::dquat rotation_at(const KeyFrames& keys, double seconds);

} // namespace argand
