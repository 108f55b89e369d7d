// Connections with the eye are the inverse of camera rays, and densities are those with which rays
// and photons are sampled.
#include "shared/light_path.h"
#include "shared/sampling.h"

#include "scene/camera.hpp"
#include "world/device_scene.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace argand::testing {
namespace {

Camera camera_at(CameraKind kind, float scale) {
    Camera camera;
    camera.kind = kind;
    camera.position = scale * glm::vec3(0.3f, -1.2f, 2.5f);
    camera.forward = glm::normalize(glm::vec3(0.2f, 0.4f, -1));
    camera.right = glm::normalize(glm::cross(camera.forward, glm::vec3(0.1f, 1, 0)));
    camera.up = glm::cross(camera.right, camera.forward);
    camera.vertical_extent = 3 * scale;
    return camera;
}

CameraRecord record_of(CameraKind kind, float scale, bool lens) {
    CameraRecord record = camera_record(camera_at(kind, scale), 40, 30);
    if (lens) {
        record.lens_radius = 0.1f * scale;
        record.inverse_focus = 1 / (3 * scale);
    }
    return record;
}

class Connections : public ::testing::TestWithParam<float> {};

TEST_P(Connections, AreTheInverseOfCameraRays) {
    const float scale = GetParam();
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 0.9999f);
    for (const CameraKind kind : {CameraKind::perspective, CameraKind::orthographic}) {
        for (const bool lens : {false, true}) {
            const CameraRecord camera = record_of(kind, scale, lens);
            for (int i = 0; i < 200; ++i) {
                const float x = 40 * unit(random), y = 30 * unit(random);
                const vec2 on_lens(unit(random), unit(random));
                vec3 origin, direction;
                camera_ray(camera, x, y, on_lens, origin, direction);
                const float distance = scale * (0.5f + 5 * unit(random));
                EyeConnection e;
                ASSERT_TRUE(connect_eye(camera, origin + direction * distance, on_lens, e));
                EXPECT_NEAR(e.x, x, 2e-3);
                EXPECT_NEAR(e.y, y, 2e-3);
                EXPECT_NEAR(glm::distance(e.direction, direction), 0, 1e-4);
                EXPECT_NEAR(e.distance, distance, 1e-4f * distance);
                EXPECT_FALSE(connect_eye(camera, origin - direction * distance, on_lens, e));
            }
        }
    }
}

TEST_P(Connections, HaveTheDensityOfCameraRays) {
    const float scale = GetParam();
    for (const CameraKind kind : {CameraKind::perspective, CameraKind::orthographic}) {
        const CameraRecord camera = record_of(kind, scale, false);
        for (const vec2 at : {vec2(20, 15), vec2(1, 1), vec2(38, 4)}) {
            // The area that a pixel covers on a plane across the ray.
            const float distance = 2 * scale;
            vec3 origin, direction;
            camera_ray(camera, at.x, at.y, vec2(0.5f), origin, direction);
            const vec3 middle = origin + direction * distance;
            const auto corner = [&](float dx, float dy) {
                vec3 o, d;
                camera_ray(camera, at.x + dx, at.y + dy, vec2(0.5f), o, d);
                const double t = glm::dot(glm::dvec3(middle - o), glm::dvec3(direction)) /
                                 glm::dot(glm::dvec3(d), glm::dvec3(direction));
                return glm::dvec3(o) + t * glm::dvec3(d);
            };
            const glm::dvec3 across = corner(0.5f, 0) - corner(-0.5f, 0);
            const glm::dvec3 down = corner(0, 0.5f) - corner(0, -0.5f);
            const double area = glm::length(glm::cross(across, down));
            EyeConnection e;
            ASSERT_TRUE(connect_eye(camera, middle, vec2(0.5f), e));
            EXPECT_NEAR(e.density * area, 1, 2e-3);
            const double falloff =
                kind == CameraKind::perspective ? double(distance) * distance : 1;
            EXPECT_NEAR(density_of_camera_rays(camera, direction) / falloff, e.density,
                        1e-3 * e.density);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scales, Connections, ::testing::Values(1.0f, 1e-6f, 1e6f));

TEST(LightPaths, SharesAreFiniteAndOrderedAtTheExtremes) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const float by_light_path : {0.0f, 1e-38f, 1e-20f, 1.0f, 1e20f, 3e38f}) {
        for (const float others : {0.0f, 1e-38f, 1.0f, 1e20f, 3e38f, infinity}) {
            for (const float scattered : {0.0f, 1.0f}) {
                const float share = share_of_light_paths(by_light_path, others, scattered);
                EXPECT_GE(share, 0);
                EXPECT_LE(share, 1);
            }
        }
    }
    EXPECT_EQ(share_of_light_paths(0, 0, 0), 0);
    EXPECT_EQ(share_of_light_paths(1e-30f, 0, 0), 1);
    EXPECT_EQ(share_of_light_paths(1, 1, 0), 0.5f);
    EXPECT_NEAR(share_of_light_paths(2, 1, 1), 4.0 / 6, 1e-6);
}

/// Photons of a light that pass a small disc in a small cone, per area, solid angle and photon; of
/// delta lights per area. targets: at which they are aimed.
struct Window {
    glm::dvec3 middle, axis;
    double radius, cone; ///< cone: the sine of its angle; 0: all directions
};

double counted_density(const LightRecord& light, const Targets& targets, const Sphere& bounds,
                       const Window& window, std::uint32_t photons) {
    double sum = 0;
    for (std::uint32_t i = 0; i < photons; ++i) {
        const vec4 a = photon_random4(3, i, 0, numbers_hashed);
        const vec4 b = photon_random4(3, i, 1, numbers_hashed);
        const vec4 c = photon_random4(3, i, 2, numbers_hashed);
        EmittedPhoton p;
        if (!light_emit_aimed(light, all_light_kinds, bounds, targets, a, b, c.x, p)) {
            continue;
        }
        const glm::dvec3 origin(p.origin), direction(p.direction);
        const double along = glm::dot(direction, window.axis);
        const double t = glm::dot(window.middle - origin, window.axis) / along;
        const glm::dvec3 at = origin + t * direction;
        const double sine = glm::length(glm::cross(direction, window.axis));
        if (t > 0 && along > 0 && glm::distance(at, window.middle) < window.radius &&
            (window.cone == 0 || sine < window.cone)) {
            sum += 1;
        }
    }
    const double pi = 3.14159265358979;
    const double area = pi * window.radius * window.radius;
    const double solid = window.cone > 0 ? pi * window.cone * window.cone : 1; // projected
    return sum / photons / area / solid;
}

TEST(LightPaths, DensityIsThatOfThePhotons) {
    const Sphere bounds{vec3(0), 3};
    for (const bool aimed : {false, true}) {
        Targets targets{};
        if (aimed) {
            targets.spheres[0] = vec4(0, 0, -1, 0.3f);
            targets.count = 1;
            targets.share = 0.4f;
        }
        const Window window{{0.05, 0, -1}, glm::normalize(glm::dvec3(0.05, 0, -1)), 0.2, 0};
        LightRecord point{};
        point.kind = light_point;
        point.r = point.g = point.b = 1;
        const vec3 direction(window.axis);
        const double expected =
            density_of_photons(point, all_light_kinds, targets, 3, 1, vec3(0), direction,
                               static_cast<float>(glm::length(window.middle)), 1);
        EXPECT_NEAR(counted_density(point, targets, bounds, window, 400'000), expected,
                    0.05 * expected)
            << "point, aimed: " << aimed;

        // A triangle of 1.5 by 1 around the origin that faces -z.
        LightRecord triangle = point;
        triangle.kind = light_triangle;
        triangle.x = -0.5f, triangle.y = -0.5f, triangle.z = 0;
        triangle.dx = -0.5f, triangle.dy = 0.5f, triangle.dz = 0;
        triangle.ex = 1, triangle.ey = 0, triangle.ez = 0;
        const Window narrow{{0, 0, -1}, {0, 0, -1}, 0.1, 0.15};
        const double of_triangle = density_of_photons(triangle, all_light_kinds, targets, 3, 1,
                                                      vec3(0), vec3(0, 0, -1), 1, 1);
        EXPECT_NEAR(counted_density(triangle, targets, bounds, narrow, 4'000'000), of_triangle,
                    0.1 * of_triangle)
            << "triangle, aimed: " << aimed;
    }
}

TEST(LightPaths, DensityOfPhotonsFromOutsideIsEvenOverTheirDisc) {
    const Sphere bounds{vec3(0), 3};
    LightRecord sun{};
    sun.kind = light_directional;
    sun.r = sun.g = sun.b = 1;
    sun.dz = -1;
    const Window window{{0.4, 0.2, 0}, {0, 0, -1}, 0.5, 0};
    const double expected =
        density_of_photons(sun, all_light_kinds, {}, 3, 1, vec3(0), vec3(0, 0, -1), 1, 1);
    EXPECT_NEAR(counted_density(sun, {}, bounds, window, 200'000), expected, 0.03 * expected);
    LightRecord sky = sun;
    sky.kind = light_sky;
    const Window cone{{0.4, 0.2, 0}, {0, 0, -1}, 1, 0.3};
    const double of_sky = density_of_photons(sky, all_light_kinds, {}, 3, 1, vec3(0),
                                             vec3(0, 0, -1), 1, UNIFORM_SPHERE_PDF);
    EXPECT_NEAR(counted_density(sky, {}, bounds, cone, 2'000'000), of_sky, 0.05 * of_sky);
}

} // namespace
} // namespace argand::testing
