#pragma once

#include "scene/camera.hpp"

#include <glm/glm.hpp>
#include <optional>

namespace argand {

/// Where points of a scene lie in a camera's picture of this ratio of width to height: from (0, 0)
/// at its top left corner to (1, 1).
class Projection {
public:
    Projection(const Camera& camera, double aspect);

    /// Nothing if the point is behind the camera, or beside a perspective one.
    std::optional<glm::dvec2> of(const glm::dvec3& point) const;

    /// By how much a point moves in parallel to the picture where it moves by this in the picture.
    glm::dvec3 moved(const glm::dvec3& point, const glm::dvec2& by) const;

private:
    double depth(const glm::dvec3& point) const;
    /// Half of the picture's sides in scene units, at this depth.
    glm::dvec2 half_sides(double depth) const;

    glm::dvec3 position_, right_, up_, forward_;
    bool orthographic_;
    glm::dvec2 half_; ///< of a perspective camera: at depth 1
};

} // namespace argand
