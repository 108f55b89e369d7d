#include "tradeoff/pilot.hpp"

#include "image/mean.hpp"
#include "image/metrics.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

namespace argand {

namespace {

constexpr std::uint64_t pilot_passes = 4;
// Squared bias over the variance of one pass of one sample, at the widths for one pass, in this project's scenes
// (docs/results/targets.md), up to a factor of about two.
constexpr double usual_bias = 0.03;

double variance_of(const std::array<Image, 2>& pictures, const Image& guess) { return rel_variance(pictures, guess, guess); }

} // namespace

std::optional<Pilot> run_pilot(const RenderPasses& render, const RenderSettings& settings) {
    using Clock = std::chrono::steady_clock;
    Pilot pilot{.settings = settings};
    const Clock::time_point start = Clock::now();
    Clock::time_point halfway = start;
    Image before;
    std::uint64_t passes = 0;
    const RenderResult result = render(settings, [&](const PictureSoFar& so_far) -> std::optional<PassPlan> {
        const bool wide_ones = so_far.passes < pilot_passes / 2;
        if (so_far.passes > 0) {
            const Image mean = so_far.layers().front().image;
            const auto done = static_cast<std::size_t>(so_far.passes - 1);
            Image& picture = (done < 2 ? pilot.wide : pilot.narrow)[done % 2];
            const auto others = static_cast<double>(done);
            picture = done > 0 ? weighted_mean(mean, others + 1, before, -others) : mean;
            before = mean;
            passes = so_far.passes;
        }
        if (so_far.passes == pilot_passes / 2) {
            halfway = Clock::now();
        }
        if (so_far.passes == pilot_passes) {
            return std::nullopt;
        }
        return PassPlan{.expected = wide_ones ? 1.0 : narrow_passes,
                        .stream = static_cast<std::uint32_t>(so_far.passes % 2)};
    });
    const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
    pilot.seconds = seconds(Clock::now() - start);
    pilot.seconds_per_pass = seconds(Clock::now() - halfway) / static_cast<double>(pilot_passes / 2);
    if (result.statistics.interrupted || passes < pilot_passes) {
        return std::nullopt;
    }
    return pilot;
}

Image best_guess(const std::vector<Pilot>& pilots) {
    Image best;
    double least = std::numeric_limits<double>::infinity();
    for (const Pilot& pilot : pilots) {
        const Image mean = smoothed(mean_of(mean_of(pilot.wide[0], pilot.wide[1]), mean_of(pilot.narrow[0], pilot.narrow[1])));
        const double variance = variance_of(pilot.narrow, mean);
        if (variance < least || best.pixels.empty()) {
            least = variance;
            best = mean;
        }
    }
    return best;
}

ErrorModel model_of(const Pilot& pilot, const Truth* truth, const Image& guess) {
    const double wide = variance_of(pilot.wide, guess), narrow = variance_of(pilot.narrow, guess);
    if (pilot.settings.method == "path") {
        return {.fixed = 0.5 * (wide + narrow), .density = 0, .bias = {0, 0}};
    }
    ErrorModel model = fit_noise(wide, narrow, narrow_passes);
    const double narrow_share = bias_share(narrow_passes);
    // Bands along edges lie within each other: what is in the wide ones alone is the difference of the two.
    const Estimate beyond = scaled(squared_difference(pilot.wide, pilot.narrow, guess), 1 / (1 - narrow_share));
    std::vector<Estimate> estimates{{usual_bias * wide, usual_bias * wide}, beyond};
    if (truth) {
        estimates.push_back(squared_difference(pilot.wide, *truth, guess));
        estimates.push_back(scaled(squared_difference(pilot.narrow, *truth, guess), 1 / narrow_share));
    }
    model.bias = pooled(estimates);
    model.bias.value = std::max(model.bias.value, 0.0);
    return model;
}

} // namespace argand
