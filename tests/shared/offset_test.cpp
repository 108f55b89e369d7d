#include "mesh.hpp"
#include "numbers.hpp"

#include <gtest/gtest.h>

namespace argand {
namespace {

using testing::any_direction;
using testing::any_magnitude;
using testing::hit_of;

TEST(NextReal, IsTheNextNumber) {
    std::mt19937 bits(1);
    const float infinity = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 100'000; ++i) {
        const float x = testing::any_finite(bits);
        ASSERT_EQ(next_real(x, true), std::nextafter(x, infinity));
        ASSERT_EQ(next_real(x, false), std::nextafter(x, -infinity));
    }
    for (const float x : {0.0f, -0.0f}) {
        EXPECT_EQ(next_real(x, true), std::numeric_limits<float>::denorm_min());
        EXPECT_EQ(next_real(x, false), -std::numeric_limits<float>::denorm_min());
    }
    EXPECT_EQ(next_real(infinity, true), infinity);
    EXPECT_EQ(next_real(-infinity, true), -infinity);
}

/// A triangle of any shape, size and place, and a point on it.
struct Case {
    vec3 v[3];
    vec3 point, error, normal;
};

Case any_case(std::mt19937& bits) {
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> uniform;
    Case c;
    const float scale = any_magnitude(bits, -40, 40);
    const float size = any_magnitude(bits, -10, 0);     // relative to the scene
    const float thickness = any_magnitude(bits, -6, 0); // slivers
    const vec3 center =
        vec3(normal(bits), normal(bits), normal(bits)) * (bits() % 4 == 0 ? 0.0f : 1.0f);
    const int flat = int(bits() % 6); // lies in a coordinate plane and starts at the origin
    const vec3 long_way = any_direction(bits);
    const vec3 sideways = any_direction(bits) * thickness;
    for (vec3& v : c.v) {
        v = (center + size * (normal(bits) * long_way + normal(bits) * sideways)) * scale;
        v[flat % 3] = flat < 3 ? 0.0f : v[flat % 3];
    }
    c.v[0] = flat < 3 ? vec3(0) : c.v[0];
    float u = uniform(bits);
    float v = uniform(bits);
    if (bits() % 4 == 0) { // near the first vertex
        u *= any_magnitude(bits, -20, 0);
        v *= any_magnitude(bits, -20, 0);
    }
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    c.point = hit_point(c.v[0], c.v[1], c.v[2], u, v, c.error);
    float length = 0;
    c.normal =
        unit_and_length(cross3((c.v[1] - c.v[0]) / scale, (c.v[2] - c.v[0]) / scale), length);
    return c;
}

/// A random direction; every other one is grazing.
vec3 any_exit_direction(vec3 normal, std::mt19937& bits) {
    vec3 w = any_direction(bits);
    if (bits() % 2 == 0) {
        w = w - normal * (dot3(w, normal) * (1 - any_magnitude(bits, -16, 0)));
    }
    return glm::normalize(w);
}

TEST(HitPoint, ErrorBoundHolds) {
    std::mt19937 bits(2);
    std::uniform_real_distribution<float> uniform;
    for (int i = 0; i < 200'000; ++i) {
        vec3 v[3];
        for (vec3& p : v) {
            p = any_direction(bits) * any_magnitude(bits, -8, 8);
        }
        float a = uniform(bits);
        float b = uniform(bits) * (1 - a);
        vec3 error;
        const vec3 p = hit_point(v[0], v[1], v[2], a, b, error);
        for (int k = 0; k < 3; ++k) {
            const double truth =
                (1 - double(a) - double(b)) * v[0][k] + double(a) * v[1][k] + double(b) * v[2][k];
            ASSERT_LE(std::abs(p[k] - truth), error[k]);
        }
    }
}

/// Height of the triangle over its length.
double slimness(const Case& c) {
    const glm::dvec3 e1 = glm::dvec3(c.v[1]) - glm::dvec3(c.v[0]);
    const glm::dvec3 e2 = glm::dvec3(c.v[2]) - glm::dvec3(c.v[0]);
    const double longest = std::max({glm::length(e1), glm::length(e2), glm::length(e2 - e1)});
    return longest > 0 ? glm::length(glm::cross(e1 / longest, e2 / longest)) : 0;
}

// A ray that leaves a triangle does not hit it again, on either side, unless the triangle is a
// needle.
TEST(OffsetOrigin, OwnTriangleIsNotHit) {
    std::mt19937 bits(3);
    int needles = 0;
    int hits = 0;
    int others = 0;
    for (int i = 0; i < 400'000; ++i) {
        const Case c = any_case(bits);
        if (c.normal == vec3(0)) {
            continue;
        }
        const vec3 w = any_exit_direction(c.normal, bits);
        const vec3 o = offset_ray_origin(c.point, c.error, c.normal, w);
        const bool hit = hit_of(ray_shear(w), o, c.v[0], c.v[1], c.v[2]).hit;
        if (slimness(c) > 1.0 / 30) {
            ASSERT_FALSE(hit) << "case " << i << ", cosine " << dot3(w, c.normal);
            ++others;
        } else {
            ++needles;
            hits += hit;
        }
    }
    EXPECT_GT(others, 150'000);
    EXPECT_LT(hits, needles / 50);
}

// The origin lies on the ray's side of the surface, at most a few roundings of its coordinates
// away.
TEST(OffsetOrigin, IsJustOffThePlane) {
    std::mt19937 bits(4);
    for (int i = 0; i < 200'000; ++i) {
        const Case c = any_case(bits);
        if (c.normal == vec3(0)) {
            continue;
        }
        const vec3 w = any_exit_direction(c.normal, bits);
        const vec3 o = offset_ray_origin(c.point, c.error, c.normal, w);
        const glm::dvec3 e1 = glm::dvec3(c.v[1]) - glm::dvec3(c.v[0]);
        const glm::dvec3 e2 = glm::dvec3(c.v[2]) - glm::dvec3(c.v[0]);
        const glm::dvec3 exact = glm::cross(glm::normalize(e1), glm::normalize(e2));
        if (glm::length(exact) < 1e-3) {
            continue; // a needle: the normal in single precision differs
        }
        const double side = dot3(w, c.normal) < 0 ? -1 : 1;
        const double height =
            side * glm::dot(glm::normalize(exact), glm::dvec3(o) - glm::dvec3(c.v[0]));
        double extent = 0;
        for (const vec3& v : c.v) {
            extent = std::max(extent, double(max_component(abs(v))));
        }
        ASSERT_GT(height, 0) << "case " << i;
        ASSERT_LT(height, 3e-6 * extent) << "case " << i;
    }
}

// Triangles that tile a plane exactly: a ray does not hit its neighbours either.
TEST(OffsetOrigin, CoplanarNeighboursAreNotHit) {
    std::mt19937 bits(5);
    std::uniform_real_distribution<float> uniform;
    for (int i = 0; i < 20'000; ++i) {
        const auto any_integer = [&] { return float(int(bits() % 65) - 32); };
        const vec3 a(any_integer(), any_integer(), any_integer());
        const vec3 b(any_integer(), any_integer(), any_integer());
        const vec3 corner = 8.0f * vec3(any_integer(), any_integer(), any_integer());
        float length = 0;
        const vec3 normal = unit_and_length(cross3(a, b), length);
        if (length == 0) {
            continue;
        }
        const float scale = std::ldexp(1.0f, int(bits() % 60) - 30);
        const auto vertex = [&](int x, int y) {
            return (corner + a * float(x) + b * float(y)) * scale;
        };
        float u = uniform(bits);
        float v = uniform(bits) * (1 - u);
        vec3 error;
        const vec3 p = hit_point(vertex(0, 0), vertex(1, 0), vertex(0, 1), u, v, error);
        const vec3 w = any_exit_direction(normal, bits);
        const vec3 o = offset_ray_origin(p, error, normal, w);
        const RayShear shear = ray_shear(w);
        for (int x = -3; x <= 3; ++x) {
            for (int y = -3; y <= 3; ++y) {
                ASSERT_FALSE(hit_of(shear, o, vertex(x, y), vertex(x + 1, y), vertex(x, y + 1)).hit)
                    << "case " << i;
                ASSERT_FALSE(
                    hit_of(shear, o, vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)).hit)
                    << "case " << i;
            }
        }
    }
}

} // namespace
} // namespace argand
