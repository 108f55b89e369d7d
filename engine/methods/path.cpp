#include "methods/eye_paths.hpp"
#include "methods/next_pass.hpp"
#include "methods/streams.hpp"

#include <algorithm>

namespace argand {

/// Unbiased path tracing with next-event estimation, multiple importance sampling (Veach and Guibas
/// 1995) and Russian roulette: the reference for everything else.
RenderResult render_path(Device& device, const Scene& scene, const RenderSettings& settings,
                         const Listeners& listeners) {
    Budget budget(settings.budget);
    const DeviceScene on_device = upload_scene(device, scene, plan_render(scene, settings));
    EyeWorkspace workspace = make_eye_workspace(
        device, on_device.plan, settings,
        camera_record(scene.cameras[settings.camera], settings.width, settings.height));
    RenderResult result;
    std::uint64_t& passes = result.statistics.passes;
    const auto plan_next = [&] {
        const auto layers = [&] {
            return resolve_film(device, workspace, settings, result.statistics);
        };
        return next_pass(listeners, budget, {passes, layers}, 1);
    };
    budget.start_pass();
    Streams streams(settings.seed);
    RenderSettings of_stream = settings;
    std::optional<PassPlan> plan = plan_next();
    while (plan) {
        const PassNumbers numbers = streams.next(plan->stream);
        of_stream.seed = numbers.seed;
        const auto first_sample = static_cast<std::uint32_t>(numbers.index * settings.samples);
        result.statistics.interrupted = !trace_eye_paths(
            device, on_device, workspace, of_stream, first_sample, settings.samples, nullptr,
            [&](double part) { return tell_progress(listeners, budget, *plan, passes, part, 1); });
        ++passes;
        const bool goes_on = has_sample_numbers(numbers.index + 1, settings.samples) &&
                             !result.statistics.interrupted;
        plan = goes_on ? plan_next() : std::nullopt;
    }
    result.layers = resolve_film(device, workspace, settings, result.statistics);
    return result;
}

} // namespace argand
