#include "autotune/estimate.hpp"

#include "image/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace argand {

namespace {

// Smoothing divides the squared bias of density estimation by about this factor; the spread is its
// relative standard deviation. Measured in this project's scenes.
constexpr double lost_by_smoothing = 2.5, spread_of_loss = 0.5;

// Clamps the brighter of two images to this multiple of the darker one, which rejects fireflies.
// Ordinary noise is seldom as large.
constexpr float most_over_darker = 1.2f;

/// The mean of all values. Its error follows from the means of 8 × 8 tiles of the image, because
/// neighbouring pixels share photons and are not independent.
Estimate mean_of_tiles(const std::vector<double>& values, int width, int height) {
    constexpr int side = 8;
    std::array<double, side * side> sums{}, counts{};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int row = y * side / height;
            const int column = x * side / width;
            const auto tile =
                static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column);
            sums[tile] += values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(x)];
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

Posterior::Posterior(const Prior& prior, std::span<const Estimate> estimates)
    : usual_(prior.usual) {
    const double range = std::log(1e4), deviation = std::log(prior.factor);
    const double half = static_cast<double>(shifts_.size() - 1) / 2;
    for (std::size_t i = 0; i < shifts_.size(); ++i) {
        shifts_[i] = range * (static_cast<double>(i) - half) / half;
        const double t = shifts_[i] / deviation;
        weights_[i] = std::log((1 - prior.unusual) * std::exp(-0.5 * t * t) /
                                   (deviation * std::sqrt(2 * std::numbers::pi)) +
                               prior.unusual / (2 * range));
        const double value = usual_ * std::exp(shifts_[i]);
        for (const Estimate& estimate : estimates) {
            // The lower bound keeps a very exact estimate from falling between two steps.
            const double off = (value - estimate.value) / std::max(estimate.error, 0.01 * value);
            weights_[i] -= 0.5 * off * off;
        }
    }
    const double most = *std::max_element(weights_.begin(), weights_.end());
    double sum = 0;
    for (double& weight : weights_) {
        weight = std::exp(weight - most);
        sum += weight;
    }
    for (double& weight : weights_) {
        weight /= sum;
    }
}

Estimate Posterior::estimate() const {
    if (!(usual_ > 0)) {
        return {0, 0};
    }
    double mean = 0, squares = 0;
    for (std::size_t i = 0; i < shifts_.size(); ++i) {
        mean += weights_[i] * shifts_[i];
        squares += weights_[i] * shifts_[i] * shifts_[i];
    }
    const double value = usual_ * std::exp(mean);
    return {value, value * std::sqrt(std::max(squares - mean * mean, 0.0))};
}

double Posterior::probability_below(double most) const {
    double sum = 0;
    for (std::size_t i = 0; i < shifts_.size(); ++i) {
        sum += usual_ * std::exp(shifts_[i]) <= most ? weights_[i] : 0;
    }
    return sum;
}

std::array<Estimate, 2> squared_difference(const ImagePair& a, const ImagePair& b,
                                           const Image& reference) {
    const auto difference = [&](auto smooth) {
        return mean_of_tiles(
            rel_products(smooth(a[0]), smooth(b[0]), smooth(a[1]), smooth(b[1]), reference),
            reference.width, reference.height);
    };
    const Estimate smooth =
        difference([](const Image& image) { return smoothed(smoothed(image)); });
    const double value = lost_by_smoothing * smooth.value;
    return {difference([](const Image& image) { return image; }),
            Estimate{value, std::hypot(lost_by_smoothing * smooth.error, spread_of_loss * value)}};
}

Image smoothed(const Image& image) {
    const auto at = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
               static_cast<std::size_t>(x);
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

Image guess_from(const ImagePair& images) {
    Image guess = images[0];
    for (std::size_t i = 0; i < guess.pixels.size(); ++i) {
        const glm::vec3 a = glm::max(images[0].pixels[i], 0.0f),
                        b = glm::max(images[1].pixels[i], 0.0f);
        guess.pixels[i] = glm::min(glm::sqrt(a) * glm::sqrt(b), most_over_darker * glm::min(a, b));
    }
    return guess;
}

} // namespace argand
