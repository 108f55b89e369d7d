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
const vec3 center(1, 2, 3);
constexpr float radius = 4;

EmittedPhoton photon_of(const LightRecord& l, uint i) {
    EmittedPhoton p;
    EXPECT_TRUE(light_emit(l, {center, radius}, random4(31, i, 0, 0), random4(31, i, 0, 1), p));
    return p;
}

LightRecord slanted_triangle(bool double_sided) {
    return triangle_light(vec3(0, 0, 4), vec3(0.5f, 2, 4.5f), vec3(2, 0.5f, 3.5f), color,
                          double_sided);
}

std::vector<LightRecord> one_of_each() {
    const vec3 down = glm::normalize(vec3(0.3f, 0.2f, -1));
    return {point_light(vec3(1, 1.5f, 5), color),
            spot_light(vec3(0.5f, 1.5f, 5), down, color, 10, 35),
            spot_light(vec3(1, 2, 5), down, color, 25, 25),
            directional_light(down, color),
            slanted_triangle(false),
            slanted_triangle(true),
            light(light_sky, color)};
}

TEST(LightEmission, EveryPhotonCarriesTheLightsPower) {
    for (const LightRecord& l : one_of_each()) {
        for (uint i = 0; i < 1000; ++i) {
            const EmittedPhoton p = photon_of(l, i);
            ASSERT_EQ(p.flux, light_power(l, radius));
            ASSERT_NEAR(dot3(p.direction, p.direction), 1, 2e-6);
            const bool on_surface = l.kind == light_triangle;
            ASSERT_NEAR(dot3(p.normal, p.normal), on_surface ? 1 : 0, 1e-6);
            if (on_surface) {
                ASSERT_GT(dot3(p.normal, p.direction), 0.0f);
            }
        }
    }
}

/// A small target, one that overlaps with it, one around most lights, and one that is very far.
Targets four_targets() {
    return {.spheres = {vec4(1, 1, 1, 0.1f), vec4(1.1f, 1.1f, 1.2f, 0.3f),
                        vec4(1, 1.5f, 4.5f, 0.7f), vec4(1e4f, 0, 0, 1)},
            .count = 4,
            .share = 0.1f};
}

/// Mean flux that passes a sphere, as light_emit or light_emit_aimed emits it.
Mean flux_through(const LightRecord& l, const vec4& sphere, const Targets& targets) {
    Mean flux;
    for (uint i = 0; i < 100'000; ++i) {
        EmittedPhoton p;
        const bool emitted =
            light_emit_aimed(l, all_light_kinds, {center, radius}, targets, random4(35, i, 0, 0),
                             random4(35, i, 0, 1), random4(35, i, 0, 2).x, p);
        const vec3 to = vec3(sphere) - p.origin;
        const float along = dot3(to, p.direction);
        const bool hit = along > 0 && dot3(to, to) - along * along < sphere.w * sphere.w;
        flux.add(emitted && hit ? p.flux.y : 0);
    }
    return flux;
}

TEST(LightEmission, AimingAtTargetsChangesNoFlux) {
    const std::vector<vec4> spheres{
        vec4(1, 1, 1, 0.1f),       // a target
        vec4(1.1f, 1, 1.1f, 0.1f), // across the rims of two
        vec4(0, 2, 1, 0.8f),       // beside them
        vec4(1, 1.5f, 5, 50),      // everything
    };
    for (const LightRecord& l : one_of_each()) {
        if (l.kind == light_directional || l.kind == light_sky) {
            continue;
        }
        for (const vec4& sphere : spheres) {
            const Mean even = flux_through(l, sphere, {});
            const Mean aimed = flux_through(l, sphere, four_targets());
            EXPECT_NEAR(aimed.value(), even.value(),
                        5 * std::hypot(aimed.deviation(), even.deviation()) + 1e-5 * even.value())
                << l.kind << ", " << sphere.x << ", " << sphere.y;
        }
        const Mean even = flux_through(l, spheres[0], {});
        const Mean aimed = flux_through(l, spheres[0], four_targets());
        // One of the spots does not shine on this target.
        EXPECT_TRUE(even.value() == 0 || aimed.deviation() < 0.5 * even.deviation()) << l.kind;
    }
}

/// The same with half of the photons aimed at a sphere in view, which overlaps with two targets.
Targets targets_and_view() {
    Targets targets = four_targets();
    targets.view = vec4(0.8f, 1, 1.1f, 0.4f);
    targets.view_share = 0.5f;
    return targets;
}

TEST(LightEmission, AimingAtWhatIsInViewChangesNoFlux) {
    Targets only_view = targets_and_view();
    only_view.count = 0;
    only_view.share = 0;
    const std::vector<vec4> spheres{only_view.view, vec4(1.2f, 1, 1.1f, 0.1f), // across rims
                                    vec4(0, 2, 1, 0.8f),                       // beside them
                                    vec4(1, 1.5f, 5, 50)};                     // everything
    for (const LightRecord& l : one_of_each()) {
        if (l.kind == light_directional || l.kind == light_sky) {
            continue;
        }
        for (const vec4& sphere : spheres) {
            const Mean even = flux_through(l, sphere, {});
            for (const Targets& targets : {only_view, targets_and_view()}) {
                const Mean aimed = flux_through(l, sphere, targets);
                EXPECT_NEAR(aimed.value(), even.value(),
                            5 * std::hypot(aimed.deviation(), even.deviation()) +
                                1e-5 * even.value())
                    << l.kind << ", " << sphere.x << ", " << targets.count;
            }
        }
    }
}

// Photons that start in a target are emitted evenly, and a target of a millionth of the scene's
// size is hit by those that are aimed at it.
TEST(LightEmission, TargetsOfAnySize) {
    const LightRecord l = point_light(vec3(1, 1.5f, 5), color);
    Targets around{.spheres = {vec4(1, 1.5f, 5, 1)}, .count = 1, .share = 0.5f};
    Targets tiny{.spheres = {vec4(1, 1, 1, 4e-6f)}, .count = 1, .share = 0.5f};
    for (uint i = 0; i < 1000; ++i) {
        const vec4 u = random4(31, i, 0, 0);
        const vec4 v = random4(31, i, 0, 1);
        EmittedPhoton p;
        EXPECT_TRUE(light_emit_aimed(l, all_light_kinds, {center, radius}, around, u, v, 0.2f, p));
        EXPECT_EQ(p.direction, photon_of(l, i).direction);
        EXPECT_NEAR(p.concentration, 1, 1e-6);
        EXPECT_TRUE(light_emit_aimed(l, all_light_kinds, {center, radius}, tiny, u, v, 0.2f, p));
        const vec3 to = vec3(1, 1, 1) - p.origin;
        const vec3 across = glm::cross(to, p.direction);
        EXPECT_LT(glm::length(across), 6e-6f);
        const double solid_angle = pi * 16e-12 / glm::dot(to, to);
        EXPECT_NEAR(p.concentration, 0.5 + 0.5 * 4 * pi / solid_angle, 1e-4 * p.concentration);
    }
}

// Photons through a patch of the floor carry the flux that light samples from the patch predict.
TEST(LightEmission, AgreesWithLightSamples) {
    const float z = 1;
    const float low = 0.2f;
    const float high = 1.8f;
    for (const LightRecord& l : one_of_each()) {
        Mean arrived;
        Mean irradiance;
        for (uint i = 0; i < 200'000; ++i) {
            const EmittedPhoton p = photon_of(l, i);
            const float t = (z - p.origin.z) / p.direction.z;
            const vec3 at = p.origin + t * p.direction;
            const bool through = t > 0 && p.direction.z < 0 && at.x > low && at.x < high &&
                                 at.y > low && at.y < high;
            arrived.add(through ? double(p.flux.x) : 0);
            const vec4 u = random4(32, i, 0, 0);
            LightSample s;
            const vec3 point(low + (high - low) * u.z, low + (high - low) * u.w, z);
            const bool lit = light_sample(l, point, vec2(u.x, u.y), s) && s.wi.z > 0;
            irradiance.add(lit ? double(s.radiance.x) * s.wi.z : 0);
        }
        const double area = double(high - low) * (high - low);
        EXPECT_GT(arrived.value(), 0.0);
        EXPECT_NEAR(arrived.value(), irradiance.value() * area,
                    5 * (arrived.deviation() + area * irradiance.deviation()) +
                        1e-4 * arrived.value())
            << l.kind;
    }
}

TEST(LightEmission, SpotsFollowTheirFalloff) {
    const vec3 axis = glm::normalize(vec3(-1, 2, 0.5f));
    const double cones[][2] = {{0, 45}, {30, 45}, {45, 45}, {0, 90}, {80, 89}, {0.5, 1}, {0, 0.5}};
    for (const auto& [inner, outer] : cones) {
        const LightRecord l = spot_light(vec3(0), axis, color, inner, outer);
        const double cos_outer = l.cos_outer;
        const double ramp = std::max(double(l.cos_inner) - cos_outer, 0.001);
        // Of the falloff, from the outer cone's cosine up to c.
        const auto integral_to = [&](double c) {
            const double x = std::min(c - cos_outer, ramp) / ramp;
            return ramp * x * x * x / 3 + std::max(c - cos_outer - ramp, 0.0);
        };
        std::vector<double> counts(32);
        const Frame f = make_frame(axis);
        std::vector<double> around(32);
        for (uint i = 0; i < 50'000; ++i) {
            const vec3 d = to_local(f, photon_of(l, i).direction);
            // 1 - cos from the sine, which keeps the digits of narrow cones.
            const double sine2 = double(d.x) * d.x + double(d.y) * d.y;
            const double cosine = 1 - sine2 / (1 + std::sqrt(std::max(1 - sine2, 0.0)));
            ASSERT_GE(cosine, cos_outer - 3e-7);
            const double share = integral_to(std::max(cosine, cos_outer)) / integral_to(1);
            ++counts[std::min<std::size_t>(31, static_cast<std::size_t>(share * 32))];
            const double turn = std::atan2(d.y, d.x) / (2 * pi) + 0.5;
            ++around[std::min<std::size_t>(31, static_cast<std::size_t>(turn * 32))];
        }
        EXPECT_LT(chi_square_deviations(counts), unlikely)
            << "inner " << inner << ", outer " << outer;
        EXPECT_LT(chi_square_deviations(around), unlikely)
            << "inner " << inner << ", outer " << outer;
    }
}

TEST(LightEmission, TrianglesEmitByTheCosineFromTheirWholeArea) {
    for (const bool double_sided : {false, true}) {
        const LightRecord l = slanted_triangle(double_sided);
        float area = 0;
        const vec3 n = light_normal(l, area);
        std::vector<double> counts(32);
        Mean centroid;
        int front = 0;
        const uint photons = 50'000;
        for (uint i = 0; i < photons; ++i) {
            const EmittedPhoton p = photon_of(l, i);
            const double cosine = dot3(p.normal, p.direction);
            ++counts[std::min<std::size_t>(31, static_cast<std::size_t>(cosine * cosine * 32))];
            front += dot3(p.normal, n) > 0;
            centroid.add(p.origin.x);
            // On the side to which it is emitted, and barely off the surface.
            const double height = glm::dot(glm::dvec3(p.origin) - glm::dvec3(light_position(l)),
                                           glm::dvec3(p.normal));
            ASSERT_GT(height, 0.0);
            ASSERT_LT(height, 2e-5);
            const vec3 b(l.dx, l.dy, l.dz);
            const vec3 c(l.ex, l.ey, l.ez);
            ASSERT_FALSE(hit_of(ray_shear(p.direction), p.origin, light_position(l), b, c).hit);
        }
        EXPECT_LT(chi_square_deviations(counts), unlikely);
        EXPECT_NEAR(front, double_sided ? photons / 2.0 : photons,
                    double_sided ? 5 * std::sqrt(photons / 4.0) : 0);
        EXPECT_NEAR(centroid.value(), (l.x + l.dx + l.ex) / 3, 5 * centroid.deviation());
    }
}

// Parallel light covers the bounding sphere and starts outside it.
TEST(LightEmission, DiscsCoverTheScene) {
    for (const LightRecord& l :
         {directional_light(glm::normalize(vec3(1, -2, 3)), color), light(light_sky, color)}) {
        Mean squared;
        double largest = 0;
        for (uint i = 0; i < 20'000; ++i) {
            const EmittedPhoton p = photon_of(l, i);
            const glm::dvec3 from_center = glm::dvec3(p.origin) - glm::dvec3(center);
            const double along = glm::dot(from_center, glm::dvec3(p.direction));
            ASSERT_LT(along, -radius);
            const double aside2 = glm::dot(from_center, from_center) - along * along;
            squared.add(aside2);
            largest = std::max(largest, aside2);
        }
        EXPECT_NEAR(squared.value(), radius * radius / 2, 5 * squared.deviation());
        EXPECT_NEAR(largest, radius * radius, 1e-2);
        EXPECT_LE(largest, radius * radius * 1.00001);
    }
}

TEST(LightEmission, DegenerateTrianglesEmitNothing) {
    EmittedPhoton p;
    const LightRecord l = triangle_light(vec3(1), vec3(2), vec3(2), color, true);
    EXPECT_FALSE(light_emit(l, {center, radius}, vec4(0.5f), vec4(0.5f), p));
    EXPECT_EQ(p.flux, vec3(0));
}

TEST(LightEmission, SinglePrecisionIsStable) {
    for (const LightRecord& l : one_of_each()) {
        for (uint i = 0; i < 2000; ++i) {
            const EmittedPhoton p = photon_of(l, i);
            const truth::Emission e = truth::light_emit(record_bytes(l), random4(31, i, 0, 0),
                                                        random4(31, i, 0, 1), center, radius);
            ASSERT_NEAR(glm::length(glm::dvec3(p.direction) - e.direction), 0, 2e-5);
            ASSERT_NEAR(glm::length(glm::dvec3(p.origin) - e.origin), 0, 2e-5);
            ASSERT_NEAR(p.flux.x, e.flux.x, 1e-5 * e.flux.x);
        }
    }
}

} // namespace
} // namespace argand
