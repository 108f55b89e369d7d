#include "materials.hpp"
#include "shared/camera.h"

#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace argand::testing;

const glm::dvec3 right(0, 0, -1), up(0, 1, 0), forward(-1, 0, 0);
constexpr int width = 64, height = 48;

/// half: half the image's height, at distance 1 (perspective) or in the scene (orthographic).
CameraRecord camera(bool perspective, double half, glm::dvec3 position) {
    const glm::dvec3 across = right * (2 * half / height);
    const glm::dvec3 down = -up * (2 * half / height);
    const glm::dvec3 corner = -0.5 * width * across - 0.5 * height * down;
    const vec3 o = rounded(perspective ? position : position + corner);
    const vec3 f = rounded(perspective ? forward + corner : forward);
    const vec3 a = rounded(across);
    const vec3 d = rounded(down);
    return {o.x, o.y, o.z, perspective ? 0.0f : 1.0f, f.x, f.y, f.z, 0, a.x, a.y, a.z, 0, d.x,
            d.y, d.z, 0};
}

void expect_near(vec3 a, glm::dvec3 b, double bound) {
    EXPECT_NEAR(a.x, b.x, bound);
    EXPECT_NEAR(a.y, b.y, bound);
    EXPECT_NEAR(a.z, b.z, bound);
}

TEST(Camera, PerspectiveRaysSpanTheAngle) {
    const double half_angle = 0.4;
    const CameraRecord c = camera(true, std::tan(half_angle), {1, 2, 3});
    vec3 o;
    vec3 d;
    camera_ray(c, 32, 24, vec2(0.3f, 0.8f), o, d);
    expect_near(o, {1, 2, 3}, 0);
    expect_near(d, forward, 1e-6);
    camera_ray(c, 32, 0, vec2(0.3f, 0.8f), o, d); // top
    expect_near(d, std::cos(half_angle) * forward + std::sin(half_angle) * up, 1e-6);
    camera_ray(c, 32, 48, vec2(0.3f, 0.8f), o, d); // bottom
    expect_near(d, std::cos(half_angle) * forward - std::sin(half_angle) * up, 1e-6);
    camera_ray(c, 64, 24, vec2(0.3f, 0.8f), o, d); // right, where the aspect ratio matters
    const double across = std::tan(half_angle) * width / height;
    expect_near(d, glm::normalize(forward + across * right), 1e-6);
}

TEST(Camera, OrthographicRaysAreParallel) {
    const CameraRecord c = camera(false, 5, {1, 2, 3});
    vec3 o;
    vec3 d;
    camera_ray(c, 0, 0, vec2(0.3f, 0.8f), o, d);
    expect_near(d, forward, 0);
    expect_near(o, glm::dvec3(1, 2, 3) + 5.0 * up - 5.0 * width / height * right, 1e-5);
    camera_ray(c, 64, 48, vec2(0.3f, 0.8f), o, d);
    expect_near(o, glm::dvec3(1, 2, 3) - 5.0 * up + 5.0 * width / height * right, 1e-5);
}

TEST(Camera, SinglePrecisionIsStable) {
    std::mt19937 bits(1);
    for (const bool perspective : {true, false}) {
        for (const double half : {1e-3, 0.5, 20.0}) {
            const CameraRecord c = camera(perspective, half, {100, -200, 300});
            for (int i = 0; i < 1000; ++i) {
                const float x = width * to_unit_float(bits);
                const float y = height * to_unit_float(bits);
                vec3 o;
                vec3 d;
                camera_ray(c, x, y, vec2(0.3f, 0.8f), o, d);
                const truth::Ray truth = truth::camera_ray(std::bit_cast<truth::Record>(c), x, y);
                expect_near(d, truth.direction, 1e-6);
                expect_near(o, truth.origin, 5e-5);
                EXPECT_NEAR(glm::length(glm::dvec3(d)), 1, 1e-6);
            }
        }
    }
}

/// `camera` with a lens of this radius.
CameraRecord with_lens(CameraRecord c, double radius, double focus) {
    c.lens_radius = static_cast<float>(radius);
    c.inverse_focus = static_cast<float>(1 / focus);
    return c;
}

TEST(Camera, RaysThroughTheLensMeetWhereTheImageIsSharp) {
    std::mt19937 bits(2);
    const glm::dvec3 position(1, 2, 3);
    for (const bool perspective : {true, false}) {
        for (const double focus : {0.1, 2.0, 1000.0}) {
            const double radius = 0.05 * focus;
            const CameraRecord c = with_lens(camera(perspective, 0.5, position), radius, focus);
            glm::dvec2 sum(0), squares(0);
            constexpr int count = 4096;
            for (int i = 0; i < count; ++i) {
                const float x = width * to_unit_float(bits), y = height * to_unit_float(bits);
                const vec2 u(to_unit_float(bits), to_unit_float(bits));
                vec3 o, d, pinhole, towards;
                camera_ray(c, x, y, u, o, d);
                pinhole_ray(c, x, y, pinhole, towards);
                const glm::dvec3 sharp = glm::dvec3(pinhole) + focus * glm::dvec3(towards);
                const glm::dvec3 found =
                    glm::dvec3(o) + focus / glm::dot(glm::dvec3(d), forward) * glm::dvec3(d);
                expect_near(vec3(found), sharp, 2e-6 * (focus + 4));
                const glm::dvec3 on_lens = glm::dvec3(o) - glm::dvec3(pinhole);
                EXPECT_NEAR(glm::dot(on_lens, forward), 0, 1e-6);
                EXPECT_LE(glm::length(on_lens), radius * 1.0001 + 1e-6);
                const glm::dvec2 place(glm::dot(on_lens, right), glm::dot(on_lens, up));
                sum += place;
                squares += place * place;
                const truth::Ray truth =
                    truth::camera_ray(std::bit_cast<truth::Record>(c), x, y, {u.x, u.y});
                expect_near(d, truth.direction, 1e-6);
                expect_near(o, truth.origin, 1e-6 * (radius + 8));
            }
            // A uniform disc has the mean 0 and, along each axis, the variance r²/4.
            for (int axis = 0; axis < 2; ++axis) {
                EXPECT_NEAR(sum[axis] / count, 0, 4 * 0.5 * radius / std::sqrt(count));
                EXPECT_NEAR(squares[axis] / count, 0.25 * radius * radius, 0.02 * radius * radius);
            }
        }
    }
}

TEST(Camera, LensFocusedAtInfinitySendsParallelRays) {
    CameraRecord c = with_lens(camera(true, 0.5, {0, 0, 0}), 3, 1);
    c.inverse_focus = 0;
    vec3 first, second, o;
    camera_ray(c, 5, 6, vec2(0.1f, 0.9f), o, first);
    camera_ray(c, 5, 6, vec2(0.7f, 0.2f), o, second);
    EXPECT_EQ(first, second);
}

} // namespace
} // namespace argand
