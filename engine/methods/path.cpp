#include "methods/eye_paths.hpp"
#include "methods/methods.hpp"

#include <algorithm>

namespace argand {

/// Unbiased path tracing with next-event estimation, multiple importance sampling (Veach and Guibas 1995) and Russian
/// roulette: the reference for everything else.
RenderResult render_path(Device& device, const Scene& scene, const RenderSettings& settings,
                         const OnProgress& progress) {
    const DeviceScene on_device = upload_scene(device, scene, settings.follow_roughness);
    EyeWorkspace workspace =
        make_eye_workspace(device, settings,
                           camera_record(scene.cameras[settings.camera], settings.width, settings.height), false);
    RenderResult result;
    result.statistics.interrupted =
        !trace_eye_paths(device, on_device, workspace, settings, 0, settings.samples, nullptr, progress);
    result.statistics.passes = 1;
    result.layers = resolve_film(device, workspace, settings, result.statistics);
    return result;
}

} // namespace argand
