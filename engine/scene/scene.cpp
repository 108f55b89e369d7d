#include "scene/scene.hpp"

#include <algorithm>
#include <cmath>

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

double longest_animation(const Scene& scene) {
    double seconds = 0;
    for (const Animation& animation : scene.animations) {
        seconds = std::max(seconds, animation.seconds);
    }
    return seconds;
}

double area(const Scene& scene, std::size_t triangle) {
    const glm::uvec3& corners = scene.triangles[triangle];
    const glm::dvec3 a(scene.positions[corners.x]);
    const glm::dvec3 b(scene.positions[corners.y]);
    const glm::dvec3 c(scene.positions[corners.z]);
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

double surface_area(const Scene& scene) {
    double sum = 0;
    for (std::size_t triangle = 0; triangle < scene.triangles.size(); ++triangle) {
        sum += area(scene, triangle);
    }
    return sum;
}

float roughness_of_phong(float exponent) {
    return static_cast<float>(std::pow(2 / (double(exponent) + 2), 0.25));
}

bool emits(const Material& material) {
    return material.emission.r > 0 || material.emission.g > 0 || material.emission.b > 0;
}

} // namespace argand
