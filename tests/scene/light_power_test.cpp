#include "scene/light_power.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace argand {
namespace {

constexpr double pi = std::numbers::pi;

// The falloff as specified by KHR_lights_punctual.
double falloff(double cosine, double inner, double outer) {
    const double scale = 1 / std::max(0.001, std::cos(inner) - std::cos(outer));
    const double offset = -std::cos(outer) * scale;
    const double linear = std::clamp(cosine * scale + offset, 0.0, 1.0);
    return linear * linear;
}

// Midpoint rule in u = cos θ over the cone, outside which the falloff is 0.
double quadrature(double inner, double outer) {
    const int steps = 2000000;
    const double low = std::cos(outer);
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        sum += falloff(low + (1 - low) * (i + 0.5) / steps, inner, outer);
    }
    return 2 * pi * sum * (1 - low) / steps;
}

TEST(SpotSolidAngle, AgreesWithQuadrature) {
    const double cones[][2] = {{0, pi / 4},      {0.2, 0.5},  {0.5, 0.5},    {0, pi / 2},
                               {pi / 2, pi / 2}, {0, 0.01},   {0.01, 0.01},  {0.001, 0.002},
                               {0.0446, 0.0447}, {0, 0.0447}, {1.4, pi / 2}, {0, 1e-4},
                               {0.3, 0.3001}};
    for (const auto& [inner, outer] : cones) {
        const double expected = quadrature(inner, outer);
        EXPECT_NEAR(spot_solid_angle(inner, outer), expected, 1e-5 * expected)
            << "inner " << inner << ", outer " << outer;
    }
}

TEST(SpotSolidAngle, OfASharpHemisphereIsNearlyTwoPi) {
    EXPECT_NEAR(spot_solid_angle(pi / 2, pi / 2), 2 * pi, 2 * pi * 0.001);
    EXPECT_LT(spot_solid_angle(0, pi / 2), 2 * pi);
}

TEST(EmittedPower, OfPointAndSpotLights) {
    Light light;
    light.intensity = {1, 2, 3};
    EXPECT_EQ(emitted_power(light), glm::dvec3(1, 2, 3) * (4 * pi));
    light.kind = LightKind::spot;
    light.inner_cone_angle = 0.25f;
    light.outer_cone_angle = 0.5f;
    EXPECT_EQ(emitted_power(light), glm::dvec3(1, 2, 3) * spot_solid_angle(0.25, 0.5));
}

TEST(EmittedPower, OfTriangles) {
    Scene scene;
    scene.positions = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
    scene.triangles = {{0, 1, 2}};
    scene.triangle_material = {0};
    scene.materials.resize(1);
    scene.materials[0].emission = {1, 0.5, 0};
    EXPECT_EQ(emitted_power(scene, 0), glm::dvec3(1, 0.5, 0) * (pi * 3));
    scene.materials[0].double_sided = true;
    EXPECT_EQ(emitted_power(scene, 0), glm::dvec3(1, 0.5, 0) * (2 * pi * 3));
}

} // namespace
} // namespace argand
