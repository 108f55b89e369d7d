#pragma once

#include "image/image.hpp"
#include <cstdint>

namespace argand::testing {

/// An image of pseudo-random values in [0, scale).
inline Image noise(int width, int height, std::uint32_t seed, float scale = 1) {
    Image image{width, height, {}};
    std::uint32_t state = seed * 2654435761u + 1;
    const auto next = [&] {
        state = state * 1664525u + 1013904223u;
        return scale * static_cast<float>(state >> 8) / 16777216.0f;
    };
    for (int i = 0; i < width * height; ++i) {
        const float r = next(), g = next(), b = next();
        image.pixels.emplace_back(r, g, b);
    }
    return image;
}

inline Image constant(int width, int height, const glm::vec3& value) {
    return {width, height, std::vector<glm::vec3>(static_cast<std::size_t>(width * height), value)};
}

} // namespace argand::testing
