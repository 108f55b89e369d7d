#include "autotune/estimate.hpp"

#include "image/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace argand {

namespace {

// Smoothing divides the squared bias of density estimation by about this factor; the spread is its
// relative standard deviation. Measured in this project's scenes.
constexpr double lost_by_smoothing = 2.5, spread_of_loss = 0.5;

// Clamps the brighter of two images to this multiple of the darker one, which rejects fireflies.
// Ordinary noise is seldom as large.
constexpr float most_over_darker = 1.2f;

// A pixel's guess is at most so many times what the pixel itself tells, whatever its neighbours do;
// and where one of two images is black, a pixel tells at least this share of their mean.
constexpr float most_over_pixel = 2.0f, least_of_mean = 0.25f;

// The lesser of the squares of two normal numbers is 1 - 2/pi of the variance on average.
constexpr double least_of_two = 1 - 2 / std::numbers::pi;

/// Mean of the values of each of 8 × 8 tiles.
std::vector<double> tile_means(const std::vector<double>& values, int width, int height) {
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
    std::vector<double> means;
    means.reserve(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (counts[i] > 0) {
            means.push_back(sums[i] / counts[i]);
        }
    }
    return means;
}

/// The mean over the picture of the product of a[0] - b[0] and a[1] - b[1], divided as in relMSE.
/// Half the difference of their squares differs from the product by the signs of their noise only:
/// its variance is that of the product, but its mean is 0, however much the product differs from
/// place to place. So it tells the noise. Neighbouring pixels share photons, but tiles are
/// independent, unless all of the picture shares them.
/// Where images of a pair differ by more than noise, the products' own spread is all there is.
Estimate mean_product(const ImagePair& a, const ImagePair& b, const Image& reference, bool alike) {
    const auto of_tiles = [&](std::size_t i, std::size_t j) {
        return tile_means(rel_products(a[i], b[i], a[j], b[j], reference), reference.width,
                          reference.height);
    };
    const std::vector<double> products = of_tiles(0, 1), first = of_tiles(0, 0),
                              second = of_tiles(1, 1);
    const auto tiles = static_cast<double>(products.size());
    const double value = std::accumulate(products.begin(), products.end(), 0.0) / tiles;
    double squares = 0;
    for (std::size_t i = 0; i < products.size(); ++i) {
        const double swapped = 0.5 * (first[i] - second[i]);
        const double spread = products[i] - value;
        squares +=
            alike ? std::min(swapped * swapped, spread * spread) / least_of_two : spread * spread;
    }
    return {value, std::sqrt(squares) / tiles};
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
                                           const Image& reference, bool alike) {
    const auto twice_smoothed = [](const ImagePair& images) {
        return ImagePair{smoothed(smoothed(images[0])), smoothed(smoothed(images[1]))};
    };
    const Estimate smooth = mean_product(twice_smoothed(a), twice_smoothed(b), reference, alike);
    const double value = lost_by_smoothing * smooth.value;
    return {mean_product(a, b, reference, alike),
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

Image guess_from_few(const ImagePair& images) {
    Image guess = guess_from({smoothed(images[0]), smoothed(images[1])});
    const Image of_pixels = guess_from(images);
    for (std::size_t i = 0; i < guess.pixels.size(); ++i) {
        const glm::vec3 mean = 0.5f * (images[0].pixels[i] + images[1].pixels[i]);
        guess.pixels[i] = glm::min(
            guess.pixels[i], most_over_pixel * glm::max(of_pixels.pixels[i], least_of_mean * mean));
    }
    return guess;
}

} // namespace argand
