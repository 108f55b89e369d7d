#pragma once

#include "methods/eye_tracing.hpp"
#include "world/device_scene.hpp"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace argand {

/// How to aim the photons of lights from outside, learnt from light that paths from the eye found
/// and that is reflected again before it reaches the eye: with an even density where little was
/// found.
std::vector<LightAim> learn_aims(const DeviceScene& scene, std::span<const FoundLight> found);

/// The random numbers with which a photon of this light (a directional one or a sky) passes the
/// point in this unit direction, if it starts on a disc before the sphere around `middle`: the
/// inverse of light_emit. For directional lights the first two are 0.5. sky: of a picture.
glm::dvec4 numbers_of_photon(const LightRecord& light, const glm::vec3& middle, double radius,
                             const glm::vec3& point, const glm::vec3& direction,
                             const SkyTable* sky = nullptr);

} // namespace argand
