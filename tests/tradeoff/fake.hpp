#pragma once

#include "support/scratch_directory.hpp"
#include "tradeoff/parameters.hpp"
#include "tradeoff/tradeoff.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace argand::testing {

inline constexpr double true_radiance = 2;

/// A picture whose true radiance is the same everywhere, with a bias and with noise of a normal
/// distribution.
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

/// Stands in for the renderer: `path` has noise alone, all others bias as well, less with more
/// photons. Times follow from the work. Counts what it is asked for.
class FakeRenderer {
public:
    explicit FakeRenderer(int interrupted_after = 1 << 30) : left_(interrupted_after) {}

    RenderTrials trials() {
        return [this](const RenderSettings& s,
                      std::span<const std::uint32_t> seeds) -> std::optional<Trials> {
            if (left_-- <= 0) {
                return std::nullopt;
            }
            keys.push_back(parameter_key(s));
            const bool is_path = s.method == "path";
            const double bias = is_path ? 0 : 10 / std::sqrt(1.0 + static_cast<double>(s.photons));
            Trials trials{.trials = {}, .peak_bytes = s.photons + s.samples};
            for (const std::uint32_t seed : seeds) {
                Trial trial{.picture = noisy(s.width, s.height, bias,
                                             (is_path ? 1 : 0.1) / std::sqrt(s.samples), seed)};
                trial.wall_seconds =
                    1e-3 * s.samples + 1e-6 * (is_path ? 0 : static_cast<double>(s.photons));
                trial.device_seconds = 0.5 * trial.wall_seconds;
                trial.statistics.radius = 0.25;
                trial.statistics.neighbours = 50;
                trial.statistics.smoothing = 1;
                trials.trials.push_back(std::move(trial));
            }
            return trials;
        };
    }

    std::vector<std::string> keys;

private:
    int left_;
};

inline Results run(FakeRenderer& renderer, const Scene& scene, const TradeoffRequest& request) {
    return measure_tradeoff(request, scene, renderer.trials(), [](std::string_view, double) {});
}

} // namespace argand::testing
