#pragma once

#include "methods/eye_tracing.hpp"
#include "photon/view_points.hpp"

#include <vector>

namespace argand {

// What the eye paths of a small version of the image query and find.

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

/// The lights that paths of a small version of the image find by path tracing. Each round has
/// random numbers of its own. Waits for the device.
std::vector<FoundLight> sample_lights(Device& device, const DeviceScene& scene,
                                      EyeWorkspace& workspace, const RenderSettings& settings,
                                      const Camera& camera, std::uint32_t round);

} // namespace argand
