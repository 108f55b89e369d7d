#include "autotune/running_error.hpp"

#include "autotune/pilot.hpp"
#include "image/mean.hpp"
#include "image/metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace argand {

namespace {

constexpr std::size_t quarters = 4;
// Passes. A few samples of a pixel are one Sobol' set, whose halves differ much more from the whole
// than the whole from the truth: after 16 passes the error of direct light seemed eightfold.
constexpr std::uint64_t least_quarter = 8;

/// Every k-th pixel of every k-th row, few enough that the error costs no time.
Image thinned(const Image& image) {
    constexpr double most_pixels = 1 << 16;
    const double pixels = static_cast<double>(image.pixels.size());
    const int k = std::max(static_cast<int>(std::ceil(std::sqrt(pixels / most_pixels))), 1);
    Image few{.width = (image.width + k - 1) / k, .height = (image.height + k - 1) / k};
    few.pixels.reserve(static_cast<std::size_t>(few.width) * static_cast<std::size_t>(few.height));
    for (int y = 0; y < image.height; y += k) {
        for (int x = 0; x < image.width; x += k) {
            few.pixels.push_back(
                image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(x)]);
        }
    }
    return few;
}

/// relMSE of the mean of both halves that is due to noise: half of their difference is as large.
double noise_of(const Image& half, const Image& all, const Image& reference) {
    const std::vector<double> squares = rel_products(half, all, half, all, reference);
    return std::accumulate(squares.begin(), squares.end(), 0.0) /
           static_cast<double>(squares.size());
}

/// What each quarter of the passes contributes to the mean of a quantity, from its means after one
/// quarter, two, ...
template <class Mean, class Combine>
std::array<Mean, quarters> apart(const std::array<Mean, quarters>& means, Combine combine) {
    std::array<Mean, quarters> parts = means;
    for (std::size_t i = 1; i < quarters; ++i) {
        const auto before = static_cast<double>(i);
        parts[i] = combine(means[i], before + 1, means[i - 1], -before);
    }
    return parts;
}

} // namespace

RunningError::RunningError(const ErrorLaw& law, std::uint64_t begun)
    : quarter_(std::max(begun, least_quarter)) {
    model_.law = law;
}

void RunningError::add(std::span<const Layer> layers) {
    means_.push_back({thinned(layers.front().image), thinned(estimated_light(layers))});
    if (means_.size() == quarters) {
        measure();
        means_ = {means_[1], means_[3]};
        quarter_ *= 2;
    }
}

void RunningError::measure() {
    const auto passes = static_cast<double>(quarters * quarter_);
    std::array<double, quarters> bias{}; // over that of the first pass
    for (std::size_t i = 0; i < quarters; ++i) {
        bias[i] = std::sqrt(bias_share(model_.law, static_cast<double>((i + 1) * quarter_)));
    }
    const double bias_lost = bias[1] - bias[3];
    const std::array<double, quarters> bias_of =
        apart(bias, [](double a, double weight_a, double b, double weight_b) {
            return weight_a * a + weight_b * b;
        });
    const std::array<Image, quarters> of_quarter =
        apart(std::array{means_[0].estimated, means_[1].estimated, means_[2].estimated,
                         means_[3].estimated},
              weighted_mean);
    const Image& half = means_[1].whole;
    const Image guess = guess_from({half, weighted_mean(means_[3].whole, 2, half, -1)});

    const double of_one = noise_after({.density = 1, .law = model_.law}, passes);
    model_.estimated = noise_of(means_[1].estimated, means_[3].estimated, guess) / of_one;
    std::array<Estimate, 2> measured = squared_difference(
        {of_quarter[0], of_quarter[1]}, {of_quarter[2], of_quarter[3]}, guess, false);
    for (Estimate& estimate : measured) {
        estimate = scaled(estimate, 1 / ((bias_of[0] - bias_of[2]) * (bias_of[1] - bias_of[3])));
    }
    model_.bias = Posterior(usual_bias_after(model_, 1), measured).estimate();
    const double noise =
        noise_of(half, means_[3].whole, guess) - bias_lost * bias_lost * model_.bias.value;
    model_.density = std::max(noise, 0.0) / of_one;
    is_measured_ = true;
}

std::optional<double> RunningError::after(std::uint64_t passes) const {
    return is_measured_ ? std::optional(error_after(model_, static_cast<double>(passes)))
                        : std::nullopt;
}

} // namespace argand
