#include "scene/light_power.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace argand {

double spot_solid_angle(double inner_cone_angle, double outer_cone_angle) {
    // With u = cos θ the integral is 2π ∫ f(u) du: a parabola from u = cos outer to u = full, where it
    // reaches 1, and 1 from there to the axis, u = 1. The 0.001 can put `full` beyond the axis; then the
    // parabola ends at the axis.
    const double outer = std::cos(outer_cone_angle);
    const double width = std::max(0.001, std::cos(inner_cone_angle) - outer);
    const double full = outer + width;
    const double to_axis = 1 - outer;
    const double integral =
        full <= 1 ? width / 3 + (1 - full) : to_axis * to_axis * to_axis / (3 * width * width);
    return 2 * std::numbers::pi * integral;
}

glm::dvec3 emitted_power(const Light& light) {
    const double solid_angle = light.kind == LightKind::spot
                                   ? spot_solid_angle(light.inner_cone_angle, light.outer_cone_angle)
                                   : 4 * std::numbers::pi;
    return glm::dvec3(light.intensity) * solid_angle;
}

glm::dvec3 emitted_power(const Scene& scene, std::size_t triangle) {
    const Material& material = scene.materials[scene.triangle_material[triangle]];
    const double sides = material.double_sided ? 2 : 1;
    return glm::dvec3(material.emission) * (sides * std::numbers::pi * area(scene, triangle));
}

} // namespace argand
