#include "mesh.hpp"
#include "oracle.hpp"
#include "shared/surface.h"

#include <gtest/gtest.h>

namespace argand {
namespace {

using testing::any_direction;
using testing::any_magnitude;

struct Case {
    std::array<vec3, 3> v, n;
    float u, w;
    vec3 direction;

    Surface surface() const {
        return make_surface({v[0], v[1], v[2], n[0], n[1], n[2]}, u, w, direction);
    }

    truth::Surface truth() const {
        const auto widened = [](const std::array<vec3, 3>& a) {
            return std::array<glm::dvec3, 3>{glm::dvec3(a[0]), glm::dvec3(a[1]), glm::dvec3(a[2])};
        };
        return truth::make_surface(widened(v), widened(n), u, w, glm::dvec3(direction));
    }
};

/// A triangle of any size and place, with a height over length down to 2^-slimmest. In one case of
/// four its vertices have the normal (0,0,0), otherwise any direction.
Case any_case(std::mt19937& bits, int slimmest) {
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> uniform;
    Case c;
    const float scale = any_magnitude(bits, -40, 40);
    const vec3 center(normal(bits), normal(bits), normal(bits));
    const vec3 side = any_direction(bits);
    const vec3 other = any_direction(bits) * any_magnitude(bits, -slimmest, 0);
    for (vec3& v : c.v) {
        v = scale * (center + normal(bits) * side + normal(bits) * other);
    }
    const bool given = bits() % 4 != 0;
    for (vec3& n : c.n) {
        n = given ? any_direction(bits) : vec3(0);
    }
    c.u = uniform(bits);
    c.w = uniform(bits) * (1 - c.u);
    c.direction = any_direction(bits);
    return c;
}

double dot_double(vec3 a, vec3 b) { return glm::dot(glm::dvec3(a), glm::dvec3(b)); }

// For any triangle and any normals, both resulting normals are unit vectors on the ray's side.
TEST(Surface, NormalsAreUnitAndFaceTheRay) {
    std::mt19937 bits(1);
    int shaded = 0;
    for (int i = 0; i < 100'000; ++i) {
        const Case c = any_case(bits, 30);
        const Surface s = c.surface();
        ASSERT_NEAR(dot_double(s.geometric_normal, s.geometric_normal), 1, 1e-6) << "case " << i;
        ASSERT_NEAR(dot_double(s.shading_normal, s.shading_normal), 1, 1e-6) << "case " << i;
        ASSERT_LE(dot_double(s.geometric_normal, c.direction), 1e-7) << "case " << i;
        ASSERT_LE(dot_double(s.shading_normal, c.direction), 1e-7) << "case " << i;
        ASSERT_GE(dot_double(s.shading_normal, s.geometric_normal), -1e-7) << "case " << i;
        shaded += s.shading_normal != s.geometric_normal;
    }
    EXPECT_GT(shaded, 20'000);
}

TEST(Surface, SinglePrecisionIsStable) {
    std::mt19937 bits(2);
    int compared = 0;
    for (int i = 0; i < 100'000; ++i) {
        const Case c = any_case(bits, 3);
        const Surface s = c.surface();
        const truth::Surface t = c.truth();
        for (int k = 0; k < 3; ++k) {
            ASSERT_LE(std::abs(double(s.position[k]) - t.position[k]), s.error[k]) << "case " << i;
        }
        // Skip cases where rounding may flip a normal: slim triangles, rays along them, normals
        // perpendicular to the ray.
        const glm::dvec3 e1 = glm::dvec3(c.v[1]) - glm::dvec3(c.v[0]);
        const glm::dvec3 e2 = glm::dvec3(c.v[2]) - glm::dvec3(c.v[0]);
        const double slim = glm::length(glm::cross(e1, e2)) / (glm::dot(e1, e1) + glm::dot(e2, e2));
        const glm::dvec3 blend = double(1 - c.u - c.w) * glm::dvec3(c.n[0]) +
                                 double(c.u) * glm::dvec3(c.n[1]) +
                                 double(c.w) * glm::dvec3(c.n[2]);
        const double length = glm::length(blend);
        const bool plain = length == 0;
        if (slim < 0.05 || std::abs(glm::dot(t.geometric_normal, glm::dvec3(c.direction))) < 1e-3 ||
            (!plain && (length < 0.1 || std::abs(glm::dot(blend, t.geometric_normal)) < 1e-3 ||
                        std::abs(glm::dot(blend, glm::dvec3(c.direction))) < 1e-3))) {
            continue;
        }
        ++compared;
        ASSERT_EQ(s.front, t.front) << "case " << i;
        ASSERT_LT(glm::length(glm::dvec3(s.geometric_normal) - t.geometric_normal), 1e-5)
            << "case " << i;
        ASSERT_LT(glm::length(glm::dvec3(s.shading_normal) - t.shading_normal), 1e-5)
            << "case " << i;
    }
    EXPECT_GT(compared, 50'000);
}

TEST(Surface, WindingDeterminesTheFront) {
    std::mt19937 bits(3);
    for (int i = 0; i < 20'000; ++i) {
        const Case c = any_case(bits, 3);
        Case other = c;
        std::swap(other.v[1], other.v[2]);
        std::swap(other.n[1], other.n[2]);
        std::swap(other.u, other.w);
        const Surface a = c.surface();
        const Surface b = other.surface();
        if (std::abs(dot3(a.geometric_normal, c.direction)) < 1e-3f) {
            continue;
        }
        ASSERT_NE(a.front, b.front) << "case " << i;
        ASSERT_EQ(a.geometric_normal, b.geometric_normal) << "case " << i;
    }
}

TEST(Surface, NormalsAcrossTheTriangleAreInterpolated) {
    Case c{{vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)},
           {vec3(0, 0, 1), vec3(0.6f, 0, 0.8f), vec3(0, 0.6f, 0.8f)},
           0,
           0,
           {0, 0, -1}};
    EXPECT_TRUE(c.surface().front);
    EXPECT_EQ(c.surface().geometric_normal, vec3(0, 0, 1));
    EXPECT_EQ(c.surface().shading_normal, vec3(0, 0, 1));
    c.u = 1;
    EXPECT_NEAR(dot3(c.surface().shading_normal, c.n[1]), 1, 1e-6);
    c.u = 0.5f;
    EXPECT_NEAR(dot3(c.surface().shading_normal, glm::normalize(c.n[0] + c.n[1])), 1, 1e-6);
    // Seen from below, everything is flipped.
    c.direction = vec3(0, 0, 1);
    EXPECT_FALSE(c.surface().front);
    EXPECT_EQ(c.surface().geometric_normal, vec3(0, 0, -1));
    EXPECT_NEAR(dot3(c.surface().shading_normal, glm::normalize(c.n[0] + c.n[1])), -1, 1e-6);
}

TEST(Surface, UnusableNormalsAreReplaced) {
    const vec3 up(0, 0, 1);
    const std::array<vec3, 3> v{vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)};
    const float infinity = std::numeric_limits<float>::infinity();
    // No normals, normals that cancel, and values that are not finite.
    for (const auto& n : {std::array<vec3, 3>{vec3(0), vec3(0), vec3(0)},
                          {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0)},
                          {vec3(infinity), vec3(0), vec3(0)},
                          {vec3(NAN), up, up}}) {
        EXPECT_EQ((Case{v, n, 0.5f, 0, {0, 0, -1}}.surface().shading_normal), up);
    }
    // A normal that faces away from a grazing ray.
    const vec3 leaning = glm::normalize(vec3(1, 0, 0.1f));
    const vec3 grazing = glm::normalize(vec3(1, 0, -0.01f));
    EXPECT_EQ((Case{v, {leaning, leaning, leaning}, 0.3f, 0.3f, grazing}.surface().shading_normal),
              up);
}

TEST(Surface, ATriangleWithoutAreaFacesTheRay) {
    const vec3 direction = glm::normalize(vec3(1, 2, 3));
    for (const auto& v : {std::array<vec3, 3>{vec3(1), vec3(1), vec3(1)},
                          {vec3(0), vec3(1, 1, 1), vec3(2, 2, 2)}}) {
        const Surface s = Case{v, {}, 0.25f, 0.25f, direction}.surface();
        EXPECT_EQ(s.geometric_normal, -direction);
        EXPECT_EQ(s.shading_normal, -direction);
    }
}

} // namespace
} // namespace argand
