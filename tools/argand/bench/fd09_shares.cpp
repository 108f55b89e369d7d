#include "base/median.hpp"
#include "bench.hpp"
#include "fd09.hpp"
#include "fd09_map.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace argand {

namespace {

struct Phase {
    const char* name;
    std::vector<std::string_view> stages;
};

/// All other stages count as rendering.
const std::array<Phase, 2> phases{
    {{"tracing", {"emit photons", "trace photons", "scatter photons", "sum flux"}},
     {"building", {"sample areas", "sort photons", "build photon map"}}}};

} // namespace

void measure_shares(Device& device, const Scene& scene, const RenderSettings& render, int runs,
                    PaperTable& shares) {
    PaperMap paper = trace_paper_map(device, scene, render);
    EyeWorkspace& eye = paper.eye;
    std::array<std::vector<double>, 4> seconds; // tracing, building, rendering, gathering
    for (int run = -1; run < runs; ++run) {
        device.reset_stage_times();
        const PhotonPass pass{.seed = render.seed,
                              .first = 0,
                              .count = paper.render.photons,
                              .bounces = render.bounces};
        paper.stored =
            trace_photons(device, paper.scene, paper.workspace, pass, 1e-6f).value_or(paper.stored);
        const PhotonMap map =
            build_photon_map(device, paper.scene, paper.workspace, paper.stored, paper.settings);
        FootprintEstimator estimator(device, paper.scene.plan);
        const PhotonLookup lookup{.map = map, .estimator = estimator};
        trace_eye_paths(device, paper.scene, eye, paper.eye_pass(paper.render.samples), &lookup,
                        [](double) { return true; });
        std::array<double, 4> sums{};
        for (const StageTime& stage : device.stage_times()) {
            std::size_t phase = 0;
            while (phase < phases.size() &&
                   std::find(phases[phase].stages.begin(), phases[phase].stages.end(),
                             stage.name) == phases[phase].stages.end()) {
                ++phase;
            }
            sums[phase] += stage.seconds;
            sums[3] += stage.name == "gather photons" ? stage.seconds : 0;
        }
        for (std::size_t i = 0; run >= 0 && i < sums.size(); ++i) {
            seconds[i].push_back(sums[i]);
        }
    }
    const double tracing = median(seconds[0]);
    const double building = median(seconds[1]);
    const double rendering = median(seconds[2]);
    const double percent = 100 / (tracing + building + rendering);
    shares.rows.push_back({{"scene", scene.name},
                           {"emitted", paper.render.photons},
                           {"hits", paper.stored.photons},
                           {"frame [s]", 100 / percent},
                           {"tracing [%]", tracing * percent},
                           {"building [%]", building * percent},
                           {"rendering [%]", rendering * percent},
                           {"of that gathering [%]", 100 * median(seconds[3]) / rendering}});
}

} // namespace argand
