#include "interactive/camera_motion.hpp"

#include "scene/direction.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtx/rotate_vector.hpp>

namespace argand {

namespace {

constexpr double nearest_to_up = glm::pi<double>() / 180;

glm::dvec3 right_of(const CameraPlace& place) {
    return unit_or_zero(glm::cross(place.target - place.position, place.up));
}

/// An offset turned about `up`, then upwards.
glm::dvec3 turned(const glm::dvec3& offset, const glm::dvec3& up, double right, double upwards) {
    const glm::dvec3 around = glm::rotate(offset, right, up);
    const double height = std::acos(std::clamp(glm::dot(unit_or_zero(around), up), -1.0, 1.0));
    const double wanted =
        std::clamp(height - upwards, nearest_to_up, glm::pi<double>() - nearest_to_up);
    const glm::dvec3 axis = unit_or_zero(glm::cross(around, up));
    return axis == glm::dvec3(0) ? around : glm::rotate(around, height - wanted, axis);
}

nlohmann::json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

} // namespace

CameraPlace place_of(const Camera& camera, double distance) {
    const glm::dvec3 forward(camera.forward);
    const bool looks_along_y = std::abs(forward.y) > std::cos(nearest_to_up);
    return {.position = glm::dvec3(camera.position),
            .target = glm::dvec3(camera.position) + distance * forward,
            .up = looks_along_y ? glm::dvec3(camera.up) : glm::dvec3(0, 1, 0)};
}

CameraPlace orbited(const CameraPlace& place, double right, double upwards) {
    CameraPlace result = place;
    result.position =
        place.target + turned(place.position - place.target, place.up, right, upwards);
    return result;
}

CameraPlace turned(const CameraPlace& place, double right, double upwards) {
    CameraPlace result = place;
    result.target =
        place.position + turned(place.target - place.position, place.up, -right, upwards);
    return result;
}

CameraPlace shifted(const CameraPlace& place, const glm::dvec3& by) {
    const glm::dvec3 forward = unit_or_zero(place.target - place.position);
    const glm::dvec3 right = right_of(place);
    const glm::dvec3 offset = by.x * right + by.y * glm::cross(right, forward) + by.z * forward;
    CameraPlace result = place;
    result.position += offset;
    result.target += offset;
    return result;
}

CameraPlace approached(const CameraPlace& place, double factor) {
    CameraPlace result = place;
    result.position = place.target + factor * (place.position - place.target);
    return result;
}

nlohmann::json edit_of(const CameraPlace& place) {
    return {{"position", numbers(place.position)},
            {"target", numbers(place.target)},
            {"up", numbers(place.up)}};
}

} // namespace argand
