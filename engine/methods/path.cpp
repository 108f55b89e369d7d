#include "methods/budget.hpp"
#include "methods/eye_paths.hpp"
#include "methods/methods.hpp"

#include <algorithm>

namespace argand {

/// Unbiased path tracing with next-event estimation, multiple importance sampling (Veach and Guibas 1995) and Russian
/// roulette: the reference for everything else.
RenderResult render_path(Device& device, const Scene& scene, const RenderSettings& settings,
                         const OnProgress& progress) {
    Budget budget(settings.budget);
    const DeviceScene on_device = upload_scene(device, scene, plan_render(scene, settings));
    EyeWorkspace workspace =
        make_eye_workspace(device, on_device.plan, settings,
                           camera_record(scene.cameras[settings.camera], settings.width, settings.height));
    RenderResult result;
    std::uint64_t& passes = result.statistics.passes;
    bool more = true;
    budget.start_pass();
    while (more) {
        const auto first_sample = static_cast<std::uint32_t>(passes * settings.samples);
        result.statistics.interrupted =
            !trace_eye_paths(device, on_device, workspace, settings, first_sample, settings.samples, nullptr,
                             [&](double part) { return progress(budget.share(passes, part, 1)); });
        ++passes;
        more = budget.another(passes, 1) && has_sample_numbers(passes, settings.samples) &&
               !result.statistics.interrupted;
    }
    result.layers = resolve_film(device, workspace, settings, result.statistics);
    return result;
}

} // namespace argand
