#include "autotune/witness.hpp"

#include "autotune/error_model.hpp"
#include "autotune/independent_halves.hpp"
#include "base/clock.hpp"
#include "image/mean.hpp"
#include "image/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace argand {

namespace {

// One-sided 95 % of a normal distribution.
constexpr double deviations = 1.645;
// A narrow witness has the bandwidth of a render of so many times the passes: half the bandwidth.
// Narrower ones see more of the bias, but their noise grows faster.
constexpr double times_passes = 64;
// A witness grows by at least and at most these factors at a time. Each time its kernels and the
// scene are set up anew; a large factor trusts a first, noisy estimate.
constexpr double least_growth = 1.5, most_growth = 8;
constexpr float far_too_bright = 4;

double most_of(const Estimate& estimate) {
    return std::max(estimate.value, 0.0) + deviations * estimate.error;
}

/// The share of the squared bias of a picture that its difference from a narrow witness shows.
double seen_by_narrow(const ErrorLaw& law) {
    const double lost = 1 - std::sqrt(bias_share(law, times_passes));
    return lost * lost;
}

float brightness(const glm::vec3& pixel) { return std::max(pixel.r + pixel.g + pixel.b, 0.0f); }

} // namespace

Testimony testimony_on(const ImagePair& picture, const ImagePair& witness, double seen,
                       const Image& guess) {
    const std::array<Estimate, 2> difference = squared_difference(picture, witness, guess);
    return {.pixels = scaled(difference[0], 1 / seen), .smooth = scaled(difference[1], 1 / seen)};
}

bool confirms(const Testimony& testimony, double most) {
    const Estimate& pixels = testimony.pixels;
    const bool smooth_may_decide = pixels.value <= most && pixels.error <= most;
    return most_of(pixels) <= most || (smooth_may_decide && most_of(testimony.smooth) <= most);
}

bool refutes(const Testimony& testimony, double expected) {
    return testimony.pixels.value - deviations * testimony.pixels.error > expected;
}

double growth_to_confirm(const Testimony& testimony, double most) {
    // The error of a product of two noisy halves falls as one over their samples.
    const auto growth = [&](const Estimate& estimate) {
        const double room = std::max(most - std::max(estimate.value, 0.0), 0.2 * most);
        return deviations * estimate.error / room;
    };
    const double by_pixels = growth(testimony.pixels),
                 by_smooth = std::max(growth(testimony.smooth), testimony.pixels.error / most);
    const double factor = std::min(by_pixels, by_smooth);
    return std::isfinite(factor) ? std::clamp(factor, least_growth, most_growth) : least_growth;
}

Image darkened_by(const ImagePair& witness, const Image& guess) {
    const Image judge = smoothed(smoothed(mean_of(witness[0], witness[1]))),
                judged = smoothed(smoothed(guess));
    Image result = guess;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const float bright = brightness(judged.pixels[i]),
                    share = far_too_bright * brightness(judge.pixels[i]);
        if (share < bright) {
            result.pixels[i] *= share / bright;
        }
    }
    return result;
}

void Witness::add(const PilotImages& images, double samples, double seconds) {
    if (!images_) {
        images_ = images;
    } else {
        const auto include = [&](ImagePair& all, const ImagePair& more) {
            for (std::size_t half = 0; half < all.size(); ++half) {
                all[half] = weighted_mean(all[half], samples_, more[half], samples);
            }
        };
        include(images_->whole, images.whole);
        include(images_->estimated, images.estimated);
    }
    samples_ += samples;
    seconds_of_all_ += seconds;
}

bool Witness::render_more(double passes, double seconds, double expected) {
    RenderSettings settings = pass_;
    settings.seed += ++renders_;
    const double plan = is_unbiased() ? std::max(passes, 2.0) : times_passes * expected;
    const Clock::time_point start = Clock::now();
    IndependentHalves whole, estimated;
    const auto is_over = [&](std::uint64_t done) {
        return static_cast<double>(done) >= passes || seconds_since(start) > seconds;
    };
    const RenderResult result =
        render_(settings, [&](const PictureSoFar& so_far) -> std::optional<PassPlan> {
            if (so_far.passes > 0 && so_far.passes == whole.next()) {
                const std::vector<Layer> layers = so_far.layers();
                whole.add(layers.front().image);
                estimated.add(estimated_light(layers));
                // Both halves have equally many passes when stream 0 is next.
                if (whole.stream() == 0 && is_over(so_far.passes)) {
                    return std::nullopt;
                }
            }
            return PassPlan{.expected = plan, .stream = whole.stream()};
        });
    const double spent = seconds_since(start);
    seconds_ += spent;
    if (whole.both_have_passes()) {
        add({.whole = whole.means(), .estimated = estimated.means()},
            static_cast<double>(whole.passes()) * settings.samples, spent);
    }
    return !result.statistics.interrupted && whole.both_have_passes();
}

const ImagePair* Witness::truth() const {
    return images_ && is_unbiased() ? &images_->estimated : nullptr;
}

double Witness::variance_per_pass(const Image& guess) const {
    return rel_variance(images_->whole, guess, guess) * passes() / 2;
}

Testimony Witness::testimony(const ImagePair& picture, const Image& guess) const {
    return testimony_on(picture, images_->whole, is_unbiased() ? 1 : seen_by_narrow(method_.law),
                        guess);
}

} // namespace argand
