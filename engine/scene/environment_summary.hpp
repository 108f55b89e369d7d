#pragma once

#include "base/json.hpp"
#include "scene/scene.hpp"

#include <string>

namespace argand {

/// Height above the horizon and compass direction, clockwise from above and from -Z over +X, both
/// in degrees.
struct SkyPlace {
    double elevation = 0, azimuth = 0;
};
SkyPlace place_of(const glm::dvec3& towards);

/// The unit direction of a place.
glm::dvec3 direction_of(const SkyPlace& place);

/// What lights the scene from outside: a picture, its brightest texel, its sun, and the power that
/// comes into the sphere around the scene. Null if nothing does, or if it is uniform.
nlohmann::ordered_json environment_json(const Scene& scene);

/// The same on one line.
std::string environment_text(const Scene& scene);

} // namespace argand
