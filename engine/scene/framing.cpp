#include "scene/framing.hpp"

#include "scene/direction.hpp"
#include <cmath>
#include <numbers>

namespace argand {

Camera frame_bounds(const Bounds& box) {
    constexpr double margin = 1.1;
    const glm::dvec3 forward = unit_or_zero({-0.45, -0.3, -1});
    const glm::dvec3 right = unit_or_zero(glm::cross(forward, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, forward);
    const glm::dvec3 center = 0.5 * (glm::dvec3(box.low) + glm::dvec3(box.high));
    const glm::dvec3 half = 0.5 * (glm::dvec3(box.high) - glm::dvec3(box.low));

    constexpr double angle = std::numbers::pi / 4;
    const double slope = std::tan(angle / 2);
    double distance = 0; // at which every corner is inside the image
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 offset =
            half * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const double wide =
            std::max(std::abs(glm::dot(offset, right)), std::abs(glm::dot(offset, up)));
        distance = std::max(distance, margin * wide / slope - glm::dot(offset, forward));
    }
    Camera camera;
    camera.name = "framed";
    camera.position = glm::vec3(center - distance * forward);
    camera.right = glm::vec3(right);
    camera.up = glm::vec3(up);
    camera.forward = glm::vec3(forward);
    camera.vertical_angle = static_cast<float>(angle);
    return camera;
}

} // namespace argand
