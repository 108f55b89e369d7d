#include "scene/placement.hpp"

#include "scene/direction.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

VertexTransform vertex_transform(const glm::dmat4& to_world) {
    // Normals are transformed by the matrix of cofactors, which is the inverse transpose up to a
    // factor and exists for singular matrices too. The matrix is first scaled to about 1 so that
    // products neither overflow nor vanish.
    glm::dmat3 m(to_world);
    double largest = 0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            largest = std::max(largest, std::abs(m[column][row]));
        }
    }
    if (largest > 0 && std::isfinite(largest)) {
        m = glm::dmat3(m[0] / largest, m[1] / largest, m[2] / largest);
    }
    const bool mirrors = glm::dot(m[0], glm::cross(m[1], m[2])) < 0;
    const double sign = mirrors ? -1 : 1;
    const glm::dmat3 cofactors(sign * glm::cross(m[1], m[2]), sign * glm::cross(m[2], m[0]),
                               sign * glm::cross(m[0], m[1]));
    return {to_world, cofactors, mirrors};
}

bool fits_float(const glm::dvec3& position) {
    constexpr double largest = std::numeric_limits<float>::max();
    return std::abs(position.x) <= largest && std::abs(position.y) <= largest &&
           std::abs(position.z) <= largest;
}

bool place(const glm::dmat4& to_world, Light& light) {
    light.position = glm::vec3(glm::dvec3(to_world[3]));
    const glm::dvec3 direction = unit_or_zero(-glm::dvec3(to_world[2]));
    if (light.kind != LightKind::point && direction == glm::dvec3(0)) {
        return false;
    }
    light.direction = glm::vec3(direction);
    return true;
}

bool place(const glm::dmat4& to_world, Camera& camera) {
    camera.position = glm::vec3(glm::dvec3(to_world[3]));
    const glm::dvec3 forward = unit_or_zero(-glm::dvec3(to_world[2]));
    const glm::dvec3 right =
        unit_or_zero(glm::cross(forward, unit_or_zero(glm::dvec3(to_world[1]))));
    if (forward == glm::dvec3(0) || right == glm::dvec3(0)) {
        return false;
    }
    camera.forward = glm::vec3(forward);
    camera.right = glm::vec3(right);
    camera.up = glm::vec3(glm::cross(right, forward));
    return true;
}

} // namespace argand
