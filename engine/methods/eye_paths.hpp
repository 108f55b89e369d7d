#pragma once

#include "base/on_progress.hpp"
#include "methods/film.hpp"
#include "methods/query_sharing.hpp"
#include "methods/render_settings.hpp"
#include "shared/path_records.h"
#include "world/device_scene.hpp"

#include <functional>

namespace argand {

/// What traces rays of eye paths if not the scene's tree. Records only.
struct EyeTracers {
    /// Rays behind the first surface: finds hits as trace_closest() does, u of a miss being
    /// ray_escaped or ray_lost. Results are the hits that the rays leave. None: the tree.
    std::function<void(const RayBatch& batch)> scattered;
    /// Shadow rays, from these hits; results: the thickness of what lies on the ray. None: the
    /// tree.
    std::function<void(const RayBatch& batch, const Buffer& hits)> shadow;
};

/// Device memory for eye paths that are traced together, and their film.
struct EyeWorkspace {
    std::uint64_t slots = 0;
    bool lattice = false; ///< the numbers of paths are points of a lattice
    bool cones = false;   ///< rays have cones, which choose mip levels
    CropRectangle crop;   ///< the part of the image that the film has
    std::uint32_t image_width = 0, image_height = 0;
    bool cropped = false;  ///< it is not the whole image
    bool filtered = false; ///< samples are placed by a filter
    Buffer camera, rays, hits, paths, layers, active, next_active, alive, shadow_rays, shadows,
        occluded;
    Buffer counts;
    Buffer weights; ///< EyeWeightRecord, if there are light paths
    EyeQueries queries;
    Traversal traversal;
    EyeTracers tracers;
    Film film;
};

/// Pixels of the whole image, whatever the crop.
inline std::uint64_t pixels_of_image(const RenderSettings& settings) {
    return static_cast<std::uint64_t>(settings.width) * static_cast<std::uint64_t>(settings.height);
}

/// Allocates only the buffers that the plan requires.
EyeWorkspace make_eye_workspace(Device& device, const Plan& plan, const RenderSettings& settings,
                                const CameraRecord& camera);

/// Sets the camera for the next pass. Records only.
void set_camera(Device& device, EyeWorkspace& workspace, const CameraRecord& camera);

/// Readies the workspace for another image of the same plan and settings: empties the film. Records
/// only.
void restart(Device& device, EyeWorkspace& workspace);

/// Which samples of every pixel are traced.
struct EyePass {
    std::uint32_t seed = 0;
    std::uint32_t first_sample = 0, samples = 0; ///< [first_sample, first_sample + samples)
    std::uint32_t bounces = 0; ///< scatterings at most between the first estimated vertex and the
                               ///< light
    /// If this is one of several passes that query one map (SampleParts), the samples of all: paths
    /// are traced together, and share estimates, as in one pass. Else 0.
    std::uint32_t samples_of_all = 0;
    /// Photons whose light paths find the same light (trace_light_paths()), for each sample of a
    /// pixel; 0: there are none.
    double light_paths = 0;
};

/// Traces paths for the pass's samples of every pixel and adds them to the film. Without `lookup`
/// these are the paths of a path tracer; with it, the photon map provides the light that estimated
/// lobes scatter more than once. Calls `progress` with the share done, and returns false if a call
/// of it did.
bool trace_eye_paths(Device& device, const DeviceScene& scene, EyeWorkspace& workspace,
                     const EyePass& pass, const PhotonLookup* lookup, const OnProgress& progress);

/// How many samples of a pixel, of a pass of so many, are traced together. photon_map: their
/// queries share estimates.
std::uint32_t samples_together(const EyeWorkspace& workspace, std::uint32_t samples,
                               bool photon_map);

} // namespace argand
