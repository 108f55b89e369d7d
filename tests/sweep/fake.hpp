#pragma once

#include "base/error.hpp"
#include "methods/scenes.hpp"
#include "scene/gltf.hpp"
#include "support/noisy_image.hpp"
#include "support/scratch_directory.hpp"
#include "sweep/parameters.hpp"
#include "sweep/tradeoff.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace argand::testing {

/// A fake renderer. `path` has only noise; all other methods also have bias, which falls with the
/// number of photons. Times follow from the numbers of photons and samples. Records the settings
/// that it renders.
class FakeRenderer {
public:
    explicit FakeRenderer(int interrupted_after = 1 << 30) : left_(interrupted_after) {}

    RenderTrials trials() {
        return [this](const RenderSettings& s,
                      std::span<const std::uint32_t> seeds) -> std::optional<Trials> {
            before(s);
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
    /// Called before a setting is rendered. Throws if the setting is to fail.
    std::function<void(const RenderSettings& settings)> before = [](const RenderSettings&) {};

private:
    int left_;
};

inline Results run(FakeRenderer& renderer, const Scene& scene, const TradeoffRequest& request) {
    return measure_tradeoff(request, scene, renderer.trials(), [](std::string_view, double) {});
}

/// Fails as a device does that lacks memory.
[[noreturn]] inline void run_out_of_memory() {
    fail("allocating 'photons': the device is out of memory");
}

/// Results of a scene without light, from a renderer of black pictures, with one seed.
inline Results run_on_a_black_scene(TradeoffRequest request) {
    Scene dark;
    add_floor(dark, 1, 0, add_material(dark, lambertian(glm::vec3(0.5f))));
    const RenderTrials black = [](const RenderSettings& s, std::span<const std::uint32_t> seeds) {
        const Image image{s.width, s.height,
                          std::vector<glm::vec3>(static_cast<std::size_t>(s.width * s.height))};
        return Trials{std::vector<Trial>(seeds.size(), Trial{.picture = image, .wall_seconds = 1}),
                      1};
    };
    request.seeds = 1;
    return measure_tradeoff(request, dark, black, [](std::string_view, double) {});
}

/// Small sweeps of a box, kept in a scratch folder.
class TradeoffTest : public ::testing::Test {
protected:
    TradeoffRequest request(const std::string& folder) const {
        TradeoffRequest request{.run = {{"scene", "cornell_area.glb"}},
                                .methods = {"photons", "path"}};
        request.extent = Extent::quick;
        request.base.width = request.base.height = 16;
        request.reference_seconds = 0;
        request.seeds = 2;
        request.folder = scratch_ / folder;
        return request;
    }

    std::string text(const std::string& file) const { return read_text(scratch_ / file); }

    /// Sweeps as `whole` did, interrupted after every third setting, in a folder each. Calls
    /// `check(folder, results)` after each.
    template <class Check> void interrupt(const FakeRenderer& whole, const Check& check) const {
        for (std::size_t stop = 0; stop < whole.keys.size(); stop += 3) {
            SCOPED_TRACE(stop);
            const std::string folder = "part" + std::to_string(stop);
            FakeRenderer first(static_cast<int>(stop));
            check(folder, run(first, scene_, request(folder)));
        }
    }

    ScratchDirectory scratch_;
    Scene scene_ = load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_area.glb");
};

} // namespace argand::testing
