#include "lights.hpp"
#include "mesh.hpp"
#include "shared/random.h"
#include "statistics.hpp"

#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace argand::testing;

constexpr double pi = 3.14159265358979323846;
const vec3 color(3, 2, 1);

LightSample sample_of(const LightRecord& l, vec3 p, vec2 u = vec2(0.3f, 0.6f)) {
    LightSample s;
    EXPECT_TRUE(light_sample(l, p, u, s));
    return s;
}

TEST(Spot, FalloffFollowsTheExtension) {
    const float inner = std::cos(0.3f);
    const float outer = std::cos(0.6f);
    EXPECT_EQ(spot_falloff(1.0f, inner, outer), 1.0f);
    EXPECT_EQ(spot_falloff(inner, inner, outer), 1.0f);
    EXPECT_EQ(spot_falloff(outer, inner, outer), 0.0f);
    EXPECT_EQ(spot_falloff(-1.0f, inner, outer), 0.0f);
    EXPECT_NEAR(spot_falloff(0.5f * (inner + outer), inner, outer), 0.25f, 1e-6);
    // A hard edge: the ramp is 0.001 wide.
    EXPECT_EQ(spot_falloff(outer, outer, outer), 0.0f);
    EXPECT_NEAR(spot_falloff(outer + 0.0005f, outer, outer), 0.25f, 1e-3);
    EXPECT_EQ(spot_falloff(outer + 0.0011f, outer, outer), 1.0f);
}

TEST(LightPower, IsTheIntegral) {
    const vec3 d(0, 0, -1);
    const auto power = [](const LightRecord& l, float radius) {
        return double(light_power(l, radius).x) / color.x;
    };
    EXPECT_NEAR(power(point_light(vec3(0), color), 1), 4 * pi, 1e-5);
    EXPECT_NEAR(power(directional_light(d, color), 3), 9 * pi, 1e-4);
    EXPECT_NEAR(power(light(light_sky, color), 3), 36 * pi * pi, 1e-3);
    const vec3 b(2, 0, 0);
    const vec3 c(1, 3, 0);
    EXPECT_NEAR(power(triangle_light(vec3(0), b, c, color, false), 1), 3 * pi, 1e-4);
    EXPECT_NEAR(power(triangle_light(vec3(0), b, c, color, true), 1), 6 * pi, 1e-4);
    EXPECT_EQ(power(triangle_light(vec3(0), b, b, color, true), 1), 0.0);
    const double cones[][2] = {{0, 45},  {10, 45}, {44.9, 45}, {45, 45}, {0, 90},
                               {89, 90}, {0, 1},   {0.5, 1},   {5, 6}};
    for (const auto& [inner, outer] : cones) {
        const LightRecord l = spot_light(vec3(0), d, color, inner, outer);
        double integral = 0;
        const int steps = 20'000;
        for (int i = 0; i < steps; ++i) { // over cos θ from the outer cone to the axis
            const double cosine = l.cos_outer + (1 - double(l.cos_outer)) * (i + 0.5) / steps;
            const double ramp = std::max(double(l.cos_inner) - l.cos_outer, 0.001);
            const double x = std::min((cosine - l.cos_outer) / ramp, 1.0);
            integral += x * x * 2 * pi * (1 - double(l.cos_outer)) / steps;
        }
        EXPECT_NEAR(power(l, 1), integral, 1e-5 * integral)
            << "inner " << inner << ", outer " << outer;
    }
}

TEST(LightSample, PointLightFollowsTheInverseSquare) {
    for (const float scale : {1e-15f, 1e-3f, 1.0f, 1e6f, 1e15f}) {
        const LightRecord l = point_light(vec3(0, 0, 4) * scale, color);
        const LightSample s = sample_of(l, vec3(3, 0, 0) * scale);
        EXPECT_TRUE(s.delta);
        EXPECT_EQ(s.pdf, 0.0f);
        EXPECT_NEAR(s.distance / scale, 5, 1e-5);
        EXPECT_NEAR(s.wi.x, -0.6, 1e-6);
        EXPECT_NEAR(s.wi.z, 0.8, 1e-6);
        EXPECT_NEAR(double(s.radiance.x) * scale * scale, color.x / 25, 1e-5);
    }
    LightSample s;
    EXPECT_FALSE(light_sample(point_light(vec3(1), color), vec3(1), vec2(0.5f), s));
    EXPECT_FALSE(light_sample(point_light(vec3(1e-25f), color), vec3(0), vec2(0.5f),
                              s)); // brighter than the largest number
}

TEST(LightSample, SpotAndDirectionalLights) {
    const LightRecord spot = spot_light(vec3(0, 0, 2), vec3(0, 0, -1), color, 20, 40);
    EXPECT_NEAR(sample_of(spot, vec3(0)).radiance.x, color.x / 4, 1e-6);
    const vec3 aside(2 * std::tan(0.52f), 0, 0); // 30 degrees
    const LightSample s = sample_of(spot, aside);
    EXPECT_NEAR(s.radiance.x,
                color.x * spot_falloff(std::cos(0.52f), spot.cos_inner, spot.cos_outer) /
                    (4 + aside.x * aside.x),
                1e-5);
    LightSample dark;
    EXPECT_FALSE(light_sample(spot, vec3(4, 0, 0), vec2(0.5f), dark));
    EXPECT_FALSE(light_sample(spot, vec3(0, 0, 3), vec2(0.5f), dark));
    const LightSample sun = sample_of(directional_light(vec3(0, 0.6f, -0.8f), color), vec3(7));
    EXPECT_EQ(sun.wi, vec3(0, -0.6f, 0.8f));
    EXPECT_EQ(sun.radiance, color);
    EXPECT_TRUE(sun.delta);
    EXPECT_EQ(sun.distance, far_away);
}

/// Irradiance at p from a polygon of radiance 1 that lies wholly above the surface (Lambert 1760).
double polygon_irradiance(const std::vector<glm::dvec3>& polygon, glm::dvec3 p, glm::dvec3 normal) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = glm::normalize(polygon[i] - p);
        const glm::dvec3 b = glm::normalize(polygon[(i + 1) % polygon.size()] - p);
        sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), normal);
    }
    return std::abs(sum) / 2;
}

TEST(LightSample, TriangleGivesLambertsIrradiance) {
    const vec3 v[3] = {vec3(1, 0, 2), vec3(-1, 0.5f, 2.5f), vec3(0.2f, 1, 1)};
    for (const bool double_sided : {false, true}) {
        for (const bool reversed : {false, true}) {
            const LightRecord l =
                triangle_light(v[0], v[reversed ? 2 : 1], v[reversed ? 1 : 2], color, double_sided);
            float area = 0;
            const vec3 normal = light_normal(l, area);
            const vec3 p(0.1f, 0.2f, 0);
            Mean irradiance;
            for (uint i = 0; i < 40'000; ++i) {
                const vec4 u = random4(21, i, 0, 0);
                LightSample s;
                if (!light_sample(l, p, vec2(u.x, u.y), s)) {
                    irradiance.add(0);
                    continue;
                }
                irradiance.add(double(s.radiance.y) * s.wi.z);
                ASSERT_FALSE(s.delta);
                ASSERT_NEAR(s.radiance.y * s.pdf, color.y, 1e-5);
                // The distance is a few roundings short of the light.
                const float cosine = std::abs(dot3(s.wi, normal));
                ASSERT_NEAR(emitter_density(1, area, s.distance, cosine), s.pdf, 1e-4 * s.pdf);
            }
            const double truth =
                polygon_irradiance({v[0], v[1], v[2]}, p, glm::dvec3(0, 0, 1)) * color.y;
            const bool faces = dot3(normal, p - v[0]) > 0 || double_sided;
            EXPECT_NEAR(irradiance.value(), faces ? truth : 0, 5 * irradiance.deviation() + 1e-9);
        }
    }
}

// The mean of 1 / pdf is the solid angle of the triangle.
TEST(LightSample, TriangleDensityMatchesItsSolidAngle) {
    const LightRecord l = triangle_light(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), color, true);
    Mean solid_angle;
    for (uint i = 0; i < 40'000; ++i) {
        const vec4 u = random4(22, i, 0, 0);
        solid_angle.add(1 / double(sample_of(l, vec3(0), vec2(u.x, u.y)).pdf));
    }
    EXPECT_NEAR(solid_angle.value(), pi / 2, 5 * solid_angle.deviation()); // an octant
}

TEST(LightSample, SkyIsUniform) {
    Mean irradiance;
    for (uint i = 0; i < 40'000; ++i) {
        const vec4 u = random4(23, i, 0, 0);
        const LightSample s = sample_of(light(light_sky, color), vec3(0), vec2(u.x, u.y));
        irradiance.add(std::max(s.wi.z, 0.0f) * double(s.radiance.z));
        ASSERT_NEAR(s.radiance.z * s.pdf, color.z, 1e-6);
        ASSERT_EQ(s.pdf, UNIFORM_SPHERE_PDF);
    }
    EXPECT_NEAR(irradiance.value(), pi * color.z, 5 * irradiance.deviation());
}

TEST(LightSample, DegenerateAndEdgeOnTrianglesAreDark) {
    LightSample s;
    const vec3 a(1, 0, 1);
    const vec3 b(0, 1, 1);
    EXPECT_FALSE(light_sample(triangle_light(a, b, b, color, true), vec3(0), vec2(0.5f), s));
    EXPECT_FALSE(light_sample(triangle_light(a, a, a, color, true), vec3(0), vec2(0.5f), s));
    EXPECT_FALSE(light_sample(triangle_light(a, b, vec3(0, 0, 1), color, true), vec3(5, 5, 1),
                              vec2(0.5f), s));
}

// The segment to the sampled point does not hit the emitter itself, and covers all but the last
// millionth of the distance: at any scale, from any point, and in front of walls too.
TEST(LightSample, ShadowRaysEndJustBeforeTheEmitter) {
    std::mt19937 bits(1);
    std::normal_distribution<float> normal;
    int sampled = 0;
    for (int i = 0; i < 200'000; ++i) {
        const float scale = any_magnitude(bits, -30, 30);
        const float size = any_magnitude(bits, -10, 0);
        const auto any_point = [&] { return vec3(normal(bits), normal(bits), normal(bits)); };
        const vec3 center = any_point();
        const vec3 v[3] = {(center + size * any_point()) * scale,
                           (center + size * any_point()) * scale,
                           (center + size * any_point()) * scale};
        const vec3 p = (center + any_magnitude(bits, -8, 2) * any_point()) * scale;
        const vec2 u(float(bits() >> 8) * 0x1p-24f, float(bits() >> 8) * 0x1p-24f);
        LightSample s;
        const LightRecord l = triangle_light(v[0], v[1], v[2], color, true);
        if (!light_sample(l, p, u, s)) {
            continue;
        }
        ++sampled;
        const vec2 b = sample_triangle(u);
        vec3 ignored;
        const vec3 q = hit_point(v[0], v[1], v[2], b.x, b.y, ignored);
        const double distance = glm::length(glm::dvec3(q) - glm::dvec3(p));
        float area = 0;
        const double cosine = std::abs(dot3(light_normal(l, area), s.wi));
        const double extent = max_component(max(abs(p), max(abs(v[0]), max(abs(v[1]), abs(v[2])))));
        ASSERT_LE(s.distance, distance);
        ASSERT_GE(s.distance, distance * (1 - 2e-6) - 3e-6 * extent / cosine) << "case " << i;
        const float longest = std::max(
            {glm::distance(v[0], v[1]), glm::distance(v[1], v[2]), glm::distance(v[2], v[0])});
        if (area / longest / longest > 0.5f / 30) { // no needle
            ASSERT_FALSE(hit_of(ray_shear(s.wi), p, v[0], v[1], v[2], 0, s.distance).hit)
                << "case " << i << ", cosine " << cosine;
        }
    }
    EXPECT_GT(sampled, 150'000);
}

TEST(LightSample, SinglePrecisionIsStable) {
    std::mt19937 bits(2);
    std::normal_distribution<float> normal;
    const auto any_point = [&] { return vec3(normal(bits), normal(bits), normal(bits)); };
    for (int i = 0; i < 100'000; ++i) {
        const float scale = any_magnitude(bits, -30, 30);
        LightRecord l = triangle_light(any_point() * scale, any_point() * scale,
                                       any_point() * scale, color, i % 3 == 0);
        if (i % 4 == 0) {
            l = spot_light(any_point() * scale, any_direction(bits), color, 90 * normal(bits), 89);
        }
        const vec3 p = any_point() * scale;
        const vec2 u(float(bits() >> 8) * 0x1p-24f, float(bits() >> 8) * 0x1p-24f);
        LightSample s;
        const bool lit = light_sample(l, p, u, s);
        const truth::LightSample t = truth::light_sample(record_bytes(l), p, u);
        if (!lit || !t.lit) {
            continue;
        }
        ASSERT_NEAR(glm::length(glm::dvec3(s.wi) - t.wi), 0,
                    1e-6 * glm::length(glm::dvec3(p)) / t.distance + 1e-5);
        if (l.kind == light_triangle) {
            float area = 0;
            const vec3 n = light_normal(l, area);
            const double cosine = std::abs(dot3(n, s.wi));
            if (cosine > 0.05 && area > 0.05 * scale * scale) {
                ASSERT_NEAR(s.pdf, t.pdf, 2e-4 * t.pdf) << "case " << i;
                ASSERT_NEAR(s.radiance.x, t.radiance.x, 2e-4 * t.radiance.x);
            }
        }
    }
}

} // namespace
} // namespace argand
