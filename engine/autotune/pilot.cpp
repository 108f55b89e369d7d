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

// Squared bias over the variance of estimated light, of one pass at the widths for one pass, in
// this project's scenes, and up to what factor (docs/results/targets.md).
constexpr double usual_bias = 0.17, spread_of_bias = 2.5;

double variance_of(const Pair& pictures, const Image& guess) {
    return rel_variance(pictures, guess, guess);
}

/// What the pass after so many others adds to the mean of all.
Image part_of(const Image& mean, const Image& before, double others) {
    return others > 0 ? weighted_mean(mean, others + 1, before, -others) : mean;
}

} // namespace

std::optional<PassPlan> PilotCourse::operator()(const PictureSoFar& so_far) {
    if (so_far.passes > 0) {
        add(so_far);
    } else {
        seconds_before_ = seconds_since(start_);
    }
    const bool may_end = so_far.passes > 0 && so_far.passes <= wide_passes;
    if (so_far.passes == pilot_passes || (may_end && is_enough_(pilot_))) {
        return std::nullopt;
    }
    return PassPlan{.expected = so_far.passes < wide_passes ? 1.0 : narrow_passes,
                    .stream = static_cast<std::uint32_t>(so_far.passes % 2)};
}

/// Takes a pass's pictures. Those that are lacking so far are taken for like what there is.
void PilotCourse::add(const PictureSoFar& so_far) {
    const std::vector<Layer> layers = so_far.layers();
    const Image &mean = layers.front().image, estimated = estimated_light(layers);
    const auto others = static_cast<double>(so_far.passes - 1);
    const bool is_narrow = so_far.passes > wide_passes;
    const std::size_t stream = (so_far.passes - 1) % 2;
    PilotPictures& pictures = is_narrow ? pilot_.narrow : pilot_.wide;
    pictures.whole[stream] = part_of(mean, before_, others);
    pictures.estimated[stream] = part_of(estimated, estimated_before_, others);
    if (so_far.passes == 1) {
        pictures.whole[1] = pictures.whole[0];
        pictures.estimated[1] = pictures.estimated[0];
    }
    if (!is_narrow) {
        pilot_.narrow = pilot_.wide;
    }
    before_ = mean;
    estimated_before_ = estimated;
    pilot_.passes = so_far.passes;
    pilot_.seconds = seconds_since(start_);
    pilot_.seconds_per_pass =
        (pilot_.seconds - seconds_before_) / static_cast<double>(pilot_.passes - passes_before_);
    if (!is_narrow) {
        seconds_before_ = pilot_.seconds;
        passes_before_ = pilot_.passes;
    }
}

Image best_guess(std::span<const Pilot> pilots) {
    Image best;
    double least = std::numeric_limits<double>::infinity();
    for (const Pilot& pilot : pilots) {
        const auto half = [&](std::size_t i) {
            return smoothed(mean_of(pilot.wide.whole[i], pilot.narrow.whole[i]));
        };
        const Image guess = guess_from({half(0), half(1)});
        const double variance = variance_of(pilot.narrow.whole, guess);
        if (variance < least || best.pixels.empty()) {
            least = variance;
            best = guess;
        }
    }
    return best;
}

Image estimated_light(std::span<const Layer> layers) {
    Image estimated = layers.front().image;
    if (const Image* direct = find_layer(layers, "direct")) {
        for (std::size_t i = 0; i < estimated.pixels.size(); ++i) {
            estimated.pixels[i] -= direct->pixels[i];
        }
    }
    return estimated;
}

ErrorModel model_of(const Pilot& pilot, const Pair* truth, const Image& guess) {
    if (pilot.passes < 2) {
        return {.fixed = std::numeric_limits<double>::infinity()};
    }
    const ErrorLaw& law = pilot.method->law;
    const double wide = variance_of(pilot.wide.whole, guess);
    if (pilot.method->abilities.unbiased) {
        return {.fixed = 0.5 * (wide + variance_of(pilot.narrow.whole, guess)),
                .density = 0,
                .bias = {0, 0},
                .law = law};
    }
    const double estimated = variance_of(pilot.wide.estimated, guess);
    const double growth = variance_of(pilot.narrow.estimated, guess) - estimated;
    ErrorModel model = fit_noise(wide, wide + growth, narrow_passes, law);
    // The bias at a narrower width is a share of that at a wide one, and so is their difference.
    const double narrow_share = bias_share(law, narrow_passes), lost = 1 - std::sqrt(narrow_share);
    std::vector<Estimate> estimates;
    const auto add = [&](const Pair& a, const Pair& b, double scale) {
        for (const Estimate& estimate : squared_difference(a, b, guess)) {
            estimates.push_back(scaled(estimate, scale));
        }
    };
    if (pilot.passes == pilot_passes) {
        add(pilot.wide.estimated, pilot.narrow.estimated, 1 / (lost * lost));
    }
    if (truth) {
        add(pilot.wide.estimated, *truth, 1);
        if (pilot.passes == pilot_passes) {
            add(pilot.narrow.estimated, *truth, 1 / narrow_share);
        }
    }
    model.bias = posterior(usual_bias * estimated, spread_of_bias, estimates);
    model.estimated = estimated;
    return model;
}

Estimate bias_of(const Pair& estimated, const ErrorModel& model, double passes, const Pair& truth,
                 const Image& guess) {
    return posterior(usual_bias * model.estimated * bias_share(model.law, passes, model.wide),
                     spread_of_bias, squared_difference(estimated, truth, guess));
}

} // namespace argand
