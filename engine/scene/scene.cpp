#include "scene/scene.hpp"

namespace argand {

Bounds bounds(const Scene& scene) {
    Bounds box;
    for (const glm::uvec3& triangle : scene.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            box.low = glm::min(box.low, scene.positions[triangle[corner]]);
            box.high = glm::max(box.high, scene.positions[triangle[corner]]);
        }
    }
    return box;
}

double surface_area(const Scene& scene) {
    double area = 0;
    for (const glm::uvec3& triangle : scene.triangles) {
        const glm::dvec3 a(scene.positions[triangle.x]);
        const glm::dvec3 b(scene.positions[triangle.y]);
        const glm::dvec3 c(scene.positions[triangle.z]);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return area;
}

bool emits(const Material& material) {
    return material.emission.r > 0 || material.emission.g > 0 || material.emission.b > 0;
}

} // namespace argand
