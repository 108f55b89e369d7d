#include "sweep/trials.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "image/files.hpp"
#include "session/render.hpp"

#include <algorithm>

namespace argand {

namespace {

constexpr int warm_up_side = 16;
constexpr std::uint64_t warm_up_photons = 2'000;

/// Settings for a quick render that uses the same kernels.
RenderSettings warm_up(RenderSettings settings) {
    settings.width = std::min(settings.width, warm_up_side);
    settings.height = std::min(settings.height, warm_up_side);
    settings.photons = std::min(settings.photons, warm_up_photons);
    settings.samples = 1;
    return settings;
}

std::optional<Trial> render_once(Device& device, const Scene& scene, const RenderSettings& settings,
                                 const std::function<bool()>& keep_going, MethodTable methods) {
    device.reset_stage_times();
    const Clock::time_point start = Clock::now();
    RenderResult result = render(
        device, scene, settings, [&](double) { return keep_going(); }, nullptr, methods);
    Trial trial;
    trial.wall_seconds = seconds_since(start);
    if (result.statistics.interrupted || !keep_going()) {
        return std::nullopt;
    }
    if (device.info().features.timestamps) {
        trial.device_seconds = 0;
        for (const StageTime& stage : device.stage_times()) {
            *trial.device_seconds += stage.seconds;
        }
    }
    trial.picture = *find_layer(result.layers, "");
    trial.statistics = result.statistics;
    return trial;
}

} // namespace

RenderTrials trials_on_device(const OpenDevice& open, const Scene& scene,
                              const std::function<bool()>& keep_going, MethodTable methods) {
    return [=, &scene](RenderSettings settings,
                       std::span<const std::uint32_t> seeds) -> std::optional<Trials> {
        const std::unique_ptr<Device> device = open();
        if (!render_once(*device, scene, warm_up(settings), keep_going, methods)) {
            return std::nullopt;
        }
        Trials trials;
        for (const std::uint32_t seed : seeds) {
            settings.seed = seed;
            std::optional<Trial> trial = render_once(*device, scene, settings, keep_going, methods);
            if (!trial) {
                return std::nullopt;
            }
            trials.trials.push_back(std::move(*trial));
        }
        trials.peak_bytes = device->memory().peak;
        return trials;
    };
}

} // namespace argand
