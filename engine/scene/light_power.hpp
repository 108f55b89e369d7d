#pragma once

#include "scene/scene.hpp"
#include <cstddef>

namespace argand {

/// Integral over all directions [sr] of a spot light's falloff, which is the square of
///   clamp((cos θ − cos outer) / max(0.001, cos inner − cos outer), 0, 1):
/// KHR_lights_punctual, "Inner and Outer Cone Angles". Times the intensity [cd] it is the emitted
/// power. Angles in radians, 0 ≤ inner ≤ outer ≤ π.
double spot_solid_angle(double inner_cone_angle, double outer_cone_angle);

/// Power per channel that a point or spot light emits: its intensity integrated over directions.
/// Precondition: not a directional light, whose power depends on the scene.
glm::dvec3 emitted_power(const Light& light);

/// Power per channel that triangle `triangle` of the scene emits: π·area·radiance, from both sides
/// if its material is double-sided.
glm::dvec3 emitted_power(const Scene& scene, std::size_t triangle);

} // namespace argand
