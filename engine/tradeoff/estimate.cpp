#include "tradeoff/estimate.hpp"

#include "image/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace argand {

namespace {

/// The error is told from the means of 8 × 8 tiles, for neighbouring pixels share photons.
Estimate mean_of_tiles(const std::vector<double>& values, int width, int height) {
    constexpr int side = 8;
    std::array<double, side * side> sums{}, counts{};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto tile = static_cast<std::size_t>(y * side / height * side + x * side / width);
            sums[tile] += values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
            ++counts[tile];
        }
    }
    double sum = 0, squares = 0, tiles = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (counts[i] > 0) {
            const double mean = sums[i] / counts[i];
            sum += mean;
            squares += mean * mean;
            ++tiles;
        }
    }
    Estimate estimate{.value = sum / tiles};
    if (tiles > 1) {
        const double variance = std::max(squares / tiles - estimate.value * estimate.value, 0.0);
        estimate.error = std::sqrt(variance / (tiles - 1));
    }
    return estimate;
}

} // namespace

Estimate pooled(std::span<const Estimate> estimates) {
    double values = 0, weights = 0;
    for (const Estimate& estimate : estimates) {
        // One without an error is taken for as good as a perfect one can be.
        const double weight = 1 / std::max(estimate.error * estimate.error, 1e-300);
        values += weight * estimate.value;
        weights += weight;
    }
    return weights > 0 ? Estimate{values / weights, 1 / std::sqrt(weights)} : Estimate{};
}

Estimate squared_difference(const std::array<Image, 2>& a, const std::array<Image, 2>& b, const Image& reference) {
    const auto wide = [](const Image& image) { return smoothed(smoothed(image)); };
    return mean_of_tiles(rel_products(wide(a[0]), wide(b[0]), wide(a[1]), wide(b[1]), reference), reference.width,
                         reference.height);
}

Image smoothed(const Image& image) {
    const auto at = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
    };
    Image result = image;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            glm::vec3 sum(0);
            float count = 0;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v) {
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u) {
                    sum += image.pixels[at(u, v)];
                    ++count;
                }
            }
            result.pixels[at(x, y)] = sum / count;
        }
    }
    return result;
}

} // namespace argand
