#pragma once

#include "image/image.hpp"

#include <cstdint>
#include <random>

namespace argand::testing {

inline constexpr double true_radiance = 2;

/// An image of uniform radiance `true_radiance` plus a bias, with normally distributed noise.
inline Image noisy(int width, int height, double bias, double deviation, std::uint32_t seed) {
    std::mt19937 bits(seed);
    std::normal_distribution<double> noise(true_radiance + bias, deviation);
    Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i) {
        const auto r = static_cast<float>(noise(bits)), g = static_cast<float>(noise(bits));
        image.pixels.emplace_back(r, g, static_cast<float>(noise(bits)));
    }
    return image;
}

} // namespace argand::testing
