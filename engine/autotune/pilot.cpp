#include "autotune/pilot.hpp"

#include "image/files.hpp"
#include "image/mean.hpp"
#include "image/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace argand {

namespace {

// Squared bias of one pass at the initial bandwidth, divided by the variance of its estimated
// light, and the factor by which it usually varies. Measured in this project's scenes
// (docs/results/targets.md).
constexpr double usual_bias = 0.17, spread_of_bias = 2.5;

double variance_of(const ImagePair& images, const Image& guess) {
    return rel_variance(images, guess, guess);
}

/// The image of the last pass alone, from the means with and without it. others: the number of
/// passes before it.
Image last_pass_of(const Image& mean, const Image& before, double others) {
    return others > 0 ? weighted_mean(mean, others + 1, before, -others) : mean;
}

} // namespace

std::optional<PassPlan> PilotControl::operator()(const PictureSoFar& so_far) {
    if (so_far.passes > 0) {
        add(so_far);
    } else {
        seconds_before_ = seconds_since(start_);
    }
    const bool may_end = so_far.passes > 0 && so_far.passes <= initial_pilot_passes;
    if (so_far.passes == pilot_passes || (may_end && is_enough_(pilot_))) {
        return std::nullopt;
    }
    return PassPlan{.expected = so_far.passes < initial_pilot_passes ? 1.0 : reduced_for_passes,
                    .stream = static_cast<std::uint32_t>(so_far.passes % 2),
                    .keeps_width = true};
}

/// Adds the images of a pass. Images that are still missing repeat the existing ones.
void PilotControl::add(const PictureSoFar& so_far) {
    const std::vector<Layer> layers = so_far.layers();
    const Image &mean = layers.front().image, estimated = estimated_light(layers),
                caustic = caustic_light(layers);
    const auto others = static_cast<double>(so_far.passes - 1);
    const bool is_reduced = so_far.passes > initial_pilot_passes;
    const std::size_t stream = (so_far.passes - 1) % 2;
    PilotImages& images = is_reduced ? pilot_.reduced : pilot_.initial;
    images.whole[stream] = last_pass_of(mean, before_, others);
    images.estimated[stream] = last_pass_of(estimated, estimated_before_, others);
    images.caustic[stream] = last_pass_of(caustic, caustic_before_, others);
    if (so_far.passes == 1) {
        images.whole[1] = images.whole[0];
        images.estimated[1] = images.estimated[0];
        images.caustic[1] = images.caustic[0];
    }
    if (!is_reduced) {
        pilot_.reduced = pilot_.initial;
    }
    before_ = mean;
    estimated_before_ = estimated;
    caustic_before_ = caustic;
    pilot_.passes = so_far.passes;
    pilot_.seconds = seconds_since(start_);
    pilot_.seconds_per_pass =
        (pilot_.seconds - seconds_before_) / static_cast<double>(pilot_.passes - passes_before_);
    if (!is_reduced) {
        seconds_before_ = pilot_.seconds;
        passes_before_ = pilot_.passes;
    }
}

Image best_guess(std::span<const Pilot> pilots) {
    Image best;
    double least = std::numeric_limits<double>::infinity();
    for (const Pilot& pilot : pilots) {
        const auto half = [&](std::size_t i) {
            return smoothed(mean_of(pilot.initial.whole[i], pilot.reduced.whole[i]));
        };
        const Image guess = guess_from({half(0), half(1)});
        const double variance = variance_of(pilot.reduced.whole, guess);
        if (variance < least || best.pixels.empty()) {
            least = variance;
            best = guess;
        }
    }
    return best;
}

void PooledImages::add(const PilotImages& more, double samples_of_more, double seconds_of_more) {
    if (!images) {
        images = more;
    } else {
        const auto include = [&](ImagePair& all, const ImagePair& others) {
            for (std::size_t half = 0; half < all.size(); ++half) {
                all[half] = weighted_mean(all[half], samples, others[half], samples_of_more);
            }
        };
        include(images->whole, more.whole);
        include(images->estimated, more.estimated);
        include(images->caustic, more.caustic);
    }
    samples += samples_of_more;
    seconds += seconds_of_more;
}

Image estimated_light(std::span<const Layer> layers) {
    const Image& whole = layers.front().image;
    const Image* direct = find_layer(layers, "direct");
    return direct ? weighted_sum(whole, 1, *direct, -1) : whole;
}

Image caustic_light(std::span<const Layer> layers) {
    if (const Image* caustic = find_layer(layers, "caustic")) {
        return *caustic;
    }
    const Image& whole = layers.front().image;
    return weighted_sum(whole, 0, whole, 0);
}

ErrorModel model_of(const Pilot& pilot, const ImagePair* truth, const Image& guess) {
    if (pilot.passes < 2) {
        return {.fixed = std::numeric_limits<double>::infinity()};
    }
    const ErrorLaw law = law_of(*pilot.method, pilot.settings);
    const double initial = variance_of(pilot.initial.whole, guess);
    if (pilot.method->abilities.unbiased) {
        return {.fixed = 0.5 * (initial + variance_of(pilot.reduced.whole, guess)),
                .density = 0,
                .bias = {0, 0},
                .law = law};
    }
    const double estimated = variance_of(pilot.initial.estimated, guess);
    const double growth = variance_of(pilot.reduced.estimated, guess) - estimated;
    ErrorModel model = fit_noise(initial, initial + growth, reduced_for_passes, law);
    // The bias at the reduced bandwidth is a fixed share of that at the initial one, and so is the
    // difference of the two.
    const double reduced_share = bias_at(law, reduced_for_passes),
                 lost = 1 - std::sqrt(reduced_share);
    std::vector<Estimate> estimates;
    const auto add = [&](const ImagePair& a, const ImagePair& b, double scale) {
        for (const Estimate& estimate : squared_difference(a, b, guess)) {
            estimates.push_back(scaled(estimate, scale));
        }
    };
    if (pilot.passes == pilot_passes) {
        add(pilot.initial.estimated, pilot.reduced.estimated, 1 / (lost * lost));
    }
    if (truth) {
        add(pilot.initial.estimated, *truth, 1);
        if (pilot.passes == pilot_passes) {
            add(pilot.reduced.estimated, *truth, 1 / reduced_share);
        }
    }
    model.bias = Posterior({.usual = usual_bias * estimated, .factor = spread_of_bias}, estimates)
                     .estimate();
    model.estimated = estimated;
    return model;
}

Prior usual_bias_after(const ErrorModel& model, double passes) {
    return {.usual =
                usual_bias * model.estimated * bias_share(model.law, passes, model.initial_passes),
            .factor = spread_of_bias};
}

Estimate bias_of(const ImagePair& estimated, const ErrorModel& model, double passes,
                 const ImagePair& truth, const Image& guess) {
    return Posterior(usual_bias_after(model, passes), squared_difference(estimated, truth, guess))
        .estimate();
}

} // namespace argand
