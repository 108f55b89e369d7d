#pragma once

#include "base/on_progress.hpp"
#include "methods/film.hpp"
#include "methods/query_sharing.hpp"
#include "methods/render_settings.hpp"
#include "shared/path_records.h"
#include "world/device_scene.hpp"

namespace argand {

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
    Film film;
};

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

/// Points at which the eye paths of a small version of the picture query the photon map, without
/// those that look for caustics only; the fourth component is 0. Waits for the device.
std::vector<glm::vec4> sample_queries(Device& device, const DeviceScene& scene,
                                      EyeWorkspace& workspace, const RenderSettings& settings,
                                      const Camera& camera);

/// The points at which the eye paths of a somewhat larger version query the photon map, for maps
/// whose discs have about this radius. Waits for the device.
ViewPoints sample_view_points(Device& device, const DeviceScene& scene, EyeWorkspace& workspace,
                              const RenderSettings& settings, const Camera& camera, double radius);

/// Which of the lookup's estimates are not to be taken, and how often that is, from the eye paths
/// of such a small version: mildly uneven ones only where many are, because looking for the few
/// costs every path some time. The lookup's map must have area samples. Waits for the device.
Untaken learn_untaken(Device& device, const DeviceScene& scene, EyeWorkspace& workspace,
                      const RenderSettings& settings, const Camera& camera,
                      const PhotonLookup& lookup);

/// Light that a path received by a shadow ray.
struct FoundLight {
    std::uint32_t light = 0; ///< index among the scene's lights
    std::uint32_t pixel = 0; ///< of the small version of the image
    bool indirect = false;   ///< the light is reflected again before it reaches the eye
    double radiance = 0;     ///< that it adds to the path's sample, as the sum of the channels
    glm::vec3 point{0};      ///< where it arrives
    glm::vec3 direction{0};  ///< unit, in which it travels
};

/// The lights that paths of a small version of the image find by path tracing. Each round has
/// random numbers of its own. Waits for the device.
std::vector<FoundLight> sample_lights(Device& device, const DeviceScene& scene,
                                      EyeWorkspace& workspace, const RenderSettings& settings,
                                      const Camera& camera, std::uint32_t round);

} // namespace argand
