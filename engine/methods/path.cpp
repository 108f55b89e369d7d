#include "methods/budget.hpp"
#include "methods/eye_paths.hpp"
#include "methods/methods.hpp"
#include "methods/streams.hpp"

#include <algorithm>

namespace argand {

/// Unbiased path tracing with next-event estimation, multiple importance sampling (Veach and Guibas 1995) and Russian
/// roulette: the reference for everything else.
RenderResult render_path(Device& device, const Scene& scene, const RenderSettings& settings,
                         const Listeners& listeners) {
    Budget budget(settings.budget);
    const DeviceScene on_device = upload_scene(device, scene, plan_render(scene, settings));
    EyeWorkspace workspace =
        make_eye_workspace(device, on_device.plan, settings,
                           camera_record(scene.cameras[settings.camera], settings.width, settings.height));
    RenderResult result;
    std::uint64_t& passes = result.statistics.passes;
    /// The next pass; none: no more.
    const auto plan_next = [&]() -> std::optional<PassPlan> {
        if (listeners.on_pass) {
            return listeners.on_pass({passes, [&] { return resolve_film(device, workspace, settings, result.statistics); }});
        }
        return passes == 0 || budget.another(passes, 1) ? std::optional(PassPlan()) : std::nullopt;
    };
    budget.start_pass();
    Streams streams(settings.seed);
    RenderSettings of_stream = settings;
    std::optional<PassPlan> plan = plan_next();
    while (plan) {
        const PassNumbers numbers = streams.next(plan->stream);
        of_stream.seed = numbers.seed;
        const auto first_sample = static_cast<std::uint32_t>(numbers.index * settings.samples);
        result.statistics.interrupted =
            !trace_eye_paths(device, on_device, workspace, of_stream, first_sample, settings.samples, nullptr,
                             [&](double part) {
                                 return listeners.progress(listeners.on_pass
                                                               ? (static_cast<double>(passes) + part) / plan->expected
                                                               : budget.share(passes, part, 1));
                             });
        ++passes;
        const bool goes_on = has_sample_numbers(numbers.index + 1, settings.samples) && !result.statistics.interrupted;
        plan = goes_on ? plan_next() : std::nullopt;
    }
    result.layers = resolve_film(device, workspace, settings, result.statistics);
    return result;
}

} // namespace argand
