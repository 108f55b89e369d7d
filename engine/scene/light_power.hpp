#pragma once

#include "scene/scene.hpp"
#include <cstddef>

namespace argand {

/// Integral over all directions [sr] of the falloff of a spot light, the square of
/// clamp((cos θ − cos outer) / max(0.001, cos inner − cos outer), 0, 1): KHR_lights_punctual,
/// "Inner and Outer Cone Angles". Times the intensity [cd], it is the power that the light emits.
/// Angles in radians, 0 ≤ inner ≤ outer ≤ π.
double spot_solid_angle(double inner_cone_angle, double outer_cone_angle);

/// Power that a point or spot light emits, intensity integrated over directions, by channel. (A
/// directional light's depends on what it lights, and is not defined here: precondition.)
glm::dvec3 emitted_power(const Light& light);

/// Power that triangle `triangle` of the scene emits, π·area·radiance, from both sides if its
/// material is double-sided.
glm::dvec3 emitted_power(const Scene& scene, std::size_t triangle);

} // namespace argand
