#include "interactive/projection.hpp"

#include <cmath>

namespace argand {

Projection::Projection(const Camera& camera, double aspect)
    : position_(camera.position), right_(camera.right), up_(camera.up), forward_(camera.forward),
      orthographic_(camera.kind == CameraKind::orthographic) {
    const double height = orthographic_ ? double(camera.vertical_extent)
                                        : std::tan(double(camera.vertical_angle) / 2);
    half_ = {aspect * height, height};
}

double Projection::depth(const glm::dvec3& point) const {
    return glm::dot(point - position_, forward_);
}

glm::dvec2 Projection::half_sides(double depth) const {
    return orthographic_ ? half_ : depth * half_;
}

std::optional<glm::dvec2> Projection::of(const glm::dvec3& point) const {
    const double at = depth(point);
    if (!(at > 0)) {
        return {};
    }
    const glm::dvec3 offset = point - position_;
    const glm::dvec2 in_picture(glm::dot(offset, right_), -glm::dot(offset, up_));
    return (in_picture / half_sides(at) + 1.0) / 2.0;
}

glm::dvec3 Projection::moved(const glm::dvec3& point, const glm::dvec2& by) const {
    const glm::dvec2 units = 2.0 * by * half_sides(depth(point));
    return units.x * right_ - units.y * up_;
}

} // namespace argand
