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
    camera_ray(c, 32, 24, o, d);
    expect_near(o, {1, 2, 3}, 0);
    expect_near(d, forward, 1e-6);
    camera_ray(c, 32, 0, o, d); // top
    expect_near(d, std::cos(half_angle) * forward + std::sin(half_angle) * up, 1e-6);
    camera_ray(c, 32, 48, o, d); // bottom
    expect_near(d, std::cos(half_angle) * forward - std::sin(half_angle) * up, 1e-6);
    camera_ray(c, 64, 24, o, d); // right, where the aspect ratio matters
    const double across = std::tan(half_angle) * width / height;
    expect_near(d, glm::normalize(forward + across * right), 1e-6);
}

TEST(Camera, OrthographicRaysAreParallel) {
    const CameraRecord c = camera(false, 5, {1, 2, 3});
    vec3 o;
    vec3 d;
    camera_ray(c, 0, 0, o, d);
    expect_near(d, forward, 0);
    expect_near(o, glm::dvec3(1, 2, 3) + 5.0 * up - 5.0 * width / height * right, 1e-5);
    camera_ray(c, 64, 48, o, d);
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
                camera_ray(c, x, y, o, d);
                const truth::Ray truth = truth::camera_ray(std::bit_cast<truth::Record>(c), x, y);
                expect_near(d, truth.direction, 1e-6);
                expect_near(o, truth.origin, 5e-5);
                EXPECT_NEAR(glm::length(glm::dvec3(d)), 1, 1e-6);
            }
        }
    }
}

} // namespace
} // namespace argand
