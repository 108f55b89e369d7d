#pragma once

#include "scene/camera.hpp"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace argand {

/// Where a camera is and what it looks at, in world space.
struct CameraPlace {
    glm::dvec3 position{0}, target{0, 0, -1};
    glm::dvec3 up{0, 1, 0}; ///< unit; the axis about which it orbits, not along the line of sight
};

/// The place of a camera that looks at a point at this distance. It orbits about +Y, or about its
/// own upward axis where it looks along +Y.
CameraPlace place_of(const Camera& camera, double distance);

/// Orbits about the target by angles [rad]: to the right about `up`, and upwards, no further than a
/// degree from `up`.
CameraPlace orbited(const CameraPlace& place, double right, double upwards);

/// Looks around from where it is, by angles [rad], within the same bounds.
CameraPlace turned(const CameraPlace& place, double right, double upwards);

/// Moves with its target: to its right, its up and forwards, in scene units.
CameraPlace shifted(const CameraPlace& place, const glm::dvec3& by);

/// Comes nearer to the target by a factor below 1, or goes away.
CameraPlace approached(const CameraPlace& place, double factor);

/// The place as an edit of a camera (scene/edits.hpp).
nlohmann::json edit_of(const CameraPlace& place);

} // namespace argand
