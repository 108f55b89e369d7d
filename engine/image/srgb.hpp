#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace argand {

/// Encodes a linear value by IEC 61966-2-1. The result is in [0, 1]; values outside are clamped,
/// NaN becomes 0.
inline double srgb_encode(double linear) {
    if (!(linear > 0)) {
        return 0;
    }
    if (linear >= 1) {
        return 1;
    }
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Inverse of `srgb_encode` on [0, 1].
inline double srgb_decode(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Relative luminance of linear RGB with Rec. 709 primaries.
inline double luminance(const glm::vec3& color) {
    return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
}

} // namespace argand
