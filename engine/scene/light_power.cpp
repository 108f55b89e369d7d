// Use the shared maths in double precision.
#define ARGAND_REAL_DOUBLE
#include "scene/light_power.hpp"

#include "shared/lights.h"
#include <cmath>
#include <numbers>

namespace argand {

double spot_solid_angle(double inner_cone_angle, double outer_cone_angle) {
    double ramp = 0;
    double ramp_share = 0;
    return oracle::spot_solid_angles(std::cos(inner_cone_angle), std::cos(outer_cone_angle), ramp,
                                     ramp_share);
}

glm::dvec3 emitted_power(const Light& light) {
    double solid_angle = 4 * std::numbers::pi;
    switch (light.kind) { // without a default, so that the compiler finds a kind that is missing
    case LightKind::spot:
        solid_angle = spot_solid_angle(light.inner_cone_angle, light.outer_cone_angle);
        break;
    case LightKind::point:
    case LightKind::directional:
        break;
    }
    return glm::dvec3(light.intensity) * solid_angle;
}

glm::dvec3 emitted_power(const Scene& scene, std::size_t triangle) {
    const Material& material = scene.materials[scene.triangle_material[triangle]];
    const double sides = material.double_sided ? 2 : 1;
    return glm::dvec3(material.emission) * (sides * std::numbers::pi * area(scene, triangle));
}

} // namespace argand
