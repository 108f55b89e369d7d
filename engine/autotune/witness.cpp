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

constexpr double confidence = 0.95;
// How often the bias is far from the usual one. A verdict doubts more than a prediction does: it is
// there for scenes unlike those in which the usual bias was measured.
constexpr double doubt = 0.5;
// The usual bias is taken to be at least this share of what is to be confirmed. Where no photons
// arrive, none would be expected.
constexpr double least_usual = 1e-3;
// A testimony with a standard error below this share of what is to be confirmed needs no
// confidence.
constexpr double exact = 0.2;
// A witness usually can tell once its standard error is this share of what is to be confirmed.
constexpr double telling = 0.6;
// A narrow witness starts anew when it should have the bandwidth of so many times the passes.
constexpr double too_wide = 2;
// Fewer unbiased passes may have missed all the rare bright paths that make up their noise.
constexpr double least_passes = 8;
// A witness grows by at least and at most these factors at a time. Each time its kernels and the
// scene are set up anew; a large factor trusts a first, noisy estimate.
constexpr double least_growth = 1.5, most_growth = 8;
constexpr float far_too_bright = 4;

Prior doubted(const Prior& usual, double most) {
    return {.usual = std::max(usual.usual, least_usual * most),
            .factor = usual.factor,
            .unusual = doubt};
}

float brightness(const glm::vec3& pixel) { return std::max(pixel.r + pixel.g + pixel.b, 0.0f); }

/// Rare bright paths that both halves of a witness missed make a squared bias look negative. As it
/// cannot be, that much of the estimate is noise.
Estimate without_negative(const Estimate& estimate) {
    return estimate.value < 0 ? Estimate{0, std::hypot(estimate.error, estimate.value)} : estimate;
}

} // namespace

Testimony testimony_on(const ImagePair& picture, const ImagePair& witness, double seen,
                       const Image& guess) {
    const std::array<Estimate, 2> difference = squared_difference(picture, witness, guess);
    return {.pixels = scaled(without_negative(difference[0]), 1 / seen),
            .smooth = scaled(without_negative(difference[1]), 1 / seen)};
}

Judgement::Judgement(const Prior& usual, const Testimony& testimony, double most)
    : testimony_(testimony), most_(most),
      most_of_others_(most - testimony.caustics.value - testimony.caustics.error),
      posterior_(doubted(usual, most), std::array{testimony.pixels, testimony.smooth}) {}

Verdict Judgement::verdict() const {
    const Estimate& caustics = testimony_.caustics;
    if (caustics.value - 2 * caustics.error > most_) {
        return Verdict::refuted;
    }
    if (most_of_others_ <= 0) {
        return Verdict::open;
    }
    const double probability = posterior_.probability_below(most_of_others_);
    if (testimony_.pixels.error < exact * most_of_others_) {
        return probability > 0.5 ? Verdict::confirmed : Verdict::refuted;
    }
    if (probability < 1 - confidence) {
        return Verdict::refuted;
    }
    // What is usual may be so small that it alone would confirm: the witness must have said so too.
    const bool has_spoken =
        std::min(testimony_.pixels.error, testimony_.smooth.error) <= most_of_others_;
    return has_spoken && probability > confidence ? Verdict::confirmed : Verdict::open;
}

Estimate Judgement::bias() const {
    const Estimate others = posterior_.estimate();
    return {others.value + testimony_.caustics.value,
            std::hypot(others.error, testimony_.caustics.error)};
}

bool Judgement::caustics_are_in_doubt() const {
    constexpr double most_share = 0.3;
    return testimony_.caustics.error > most_share * most_;
}

double Judgement::growth() const {
    // The error of a product of two noisy halves falls as one over their samples.
    const double error = caustics_are_in_doubt()
                             ? testimony_.caustics.error
                             : std::min(testimony_.pixels.error, testimony_.smooth.error),
                 factor = error / (telling * most_);
    return std::isfinite(factor) ? std::clamp(factor, least_growth, most_growth) : most_growth;
}

Image sharpened_by(const ImagePair& narrow, const Image& blurred) {
    Image sharp = blurred;
    for (std::size_t i = 0; i < sharp.pixels.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const float first = narrow[0].pixels[i][k] - blurred.pixels[i][k],
                        second = narrow[1].pixels[i][k] - blurred.pixels[i][k];
            if (first * second > 0) {
                sharp.pixels[i][k] += std::abs(first) < std::abs(second) ? first : second;
            }
        }
    }
    return sharp;
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
    all_.add(images, samples, seconds);
}

bool Witness::render_more(double passes, double seconds, double expected) {
    RenderSettings settings = pass_;
    settings.seed += ++renders_;
    if (!is_unbiased() && narrow_for_ * expected > too_wide * planned_for_) {
        planned_for_ = narrow_for_ * expected;
        all_ = {};
    }
    const double plan = is_unbiased() ? std::max(passes, 2.0) : planned_for_;
    const Clock::time_point start = Clock::now();
    IndependentHalves whole, estimated, caustic;
    const auto is_over = [&](std::uint64_t done) {
        return static_cast<double>(done) >= passes || seconds_since(start) > seconds;
    };
    const RenderResult result =
        render_(settings, [&](const PictureSoFar& so_far) -> std::optional<PassPlan> {
            if (so_far.passes > 0 && so_far.passes == whole.next()) {
                const std::vector<Layer> layers = so_far.layers();
                whole.add(layers.front().image);
                estimated.add(estimated_light(layers));
                caustic.add(caustic_light(layers));
                // Both halves have equally many passes when stream 0 is next.
                if (whole.stream() == 0 && is_over(so_far.passes)) {
                    return std::nullopt;
                }
            }
            return PassPlan{.expected = plan, .stream = whole.stream(), .keeps_width = true};
        });
    const double spent = seconds_since(start);
    seconds_ += spent;
    if (whole.both_have_passes()) {
        add({.whole = whole.means(), .estimated = estimated.means(), .caustic = caustic.means()},
            static_cast<double>(whole.passes()) * settings.samples, spent);
    }
    return !result.statistics.interrupted && whole.both_have_passes();
}

const ImagePair* Witness::truth() const {
    return all_.images && is_unbiased() ? &all_.images->estimated : nullptr;
}

double Witness::passes_missing() const {
    return is_unbiased() ? std::max(least_passes - passes(), 0.0) : 0;
}

double Witness::variance_per_pass(const Image& guess) const {
    return rel_variance(all_.images->whole, guess, guess) * passes() / 2;
}

/// The bias (not squared) at its own bandwidth, over that of one pass at the initial bandwidth.
double Witness::own_bias() const {
    return is_unbiased() ? 0 : std::sqrt(bias_at(law_of(method_, pass_), planned_for_));
}

Testimony Witness::testimony(const ImagePair& picture, double bias, const Image& guess) const {
    const double seen = 1 - own_bias() / bias;
    return testimony_on(picture, all_.images->whole, seen * seen, guess);
}

Estimate Witness::testimony_on_caustics(const ImagePair& caustics, double bias,
                                        const Image& guess) const {
    // The law is that of edges. The peaks of caustics are blurred with the square of the width.
    const double own = own_bias() / bias, seen = 1 - own * own;
    return testimony_on(caustics, all_.images->caustic, seen * seen, guess).pixels;
}

} // namespace argand
