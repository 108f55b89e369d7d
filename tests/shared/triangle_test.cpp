#include "mesh.hpp"
#include "numbers.hpp"

#include <gtest/gtest.h>

namespace argand {
namespace {

using testing::any_direction;
using testing::closed_mesh;
using testing::hit_of;
using testing::Mesh;
using testing::TriangleHit;

/// Möller and Trumbore's algorithm in double precision: determinant relative to the size of its
/// terms, and t, u, v.
struct Truth {
    double determinant, t, u, v;
};
Truth intersect_in_double(vec3 origin, vec3 direction, vec3 v0, vec3 v1, vec3 v2) {
    const glm::dvec3 d(direction);
    const glm::dvec3 e1 = glm::dvec3(v1) - glm::dvec3(v0);
    const glm::dvec3 e2 = glm::dvec3(v2) - glm::dvec3(v0);
    const glm::dvec3 p = glm::cross(d, e2);
    const double determinant = glm::dot(e1, p);
    const glm::dvec3 s = glm::dvec3(origin) - glm::dvec3(v0);
    const glm::dvec3 q = glm::cross(s, e1);
    return {determinant / (glm::length(e1) * glm::length(e2)), glm::dot(e2, q) / determinant,
            glm::dot(s, p) / determinant, glm::dot(d, q) / determinant};
}

TEST(Triangle, AgreesWithDoublePrecision) {
    std::mt19937 bits(1);
    std::normal_distribution<float> normal;
    int hits = 0;
    for (int i = 0; i < 300'000; ++i) {
        const float scale = testing::any_magnitude(bits, -40, 40);
        vec3 v[4];
        for (vec3& p : v) {
            p = vec3(normal(bits), normal(bits), normal(bits)) * scale;
        }
        const vec3 direction = any_direction(bits);
        const TriangleHit h = hit_of(ray_shear(direction), v[3], v[0], v[1], v[2]);
        const Truth truth = intersect_in_double(v[3], direction, v[0], v[1], v[2]);
        const double w = 1 - truth.u - truth.v;
        const double error =
            3e-6 / std::abs(truth.determinant); // grows as the triangle is seen edge-on
        const double depth = truth.t / scale;
        if (error > 0.01) {
            continue;
        }
        const double inside = std::min(std::min(truth.u, truth.v), w);
        if (inside > error && depth > 10 * error) {
            ASSERT_TRUE(h.hit);
        }
        if (inside < -error || depth < -10 * error) {
            ASSERT_FALSE(h.hit);
        }
        if (h.hit) {
            ++hits;
            ASSERT_NEAR(h.u, truth.u, error);
            ASSERT_NEAR(h.v, truth.v, error);
            ASSERT_NEAR(h.t / scale, depth, 10 * error);
        }
    }
    EXPECT_GT(hits, 10'000);
}

TEST(Triangle, IsHitFromBothSidesAndInBothWindings) {
    std::mt19937 bits(2);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 20'000; ++i) {
        const vec3 a(normal(bits), normal(bits), normal(bits));
        const vec3 b(normal(bits), normal(bits), normal(bits));
        const vec3 c(normal(bits), normal(bits), normal(bits));
        const vec3 origin(normal(bits), normal(bits), normal(bits));
        const RayShear shear = ray_shear(any_direction(bits));
        const TriangleHit h = hit_of(shear, origin, a, b, c);
        const TriangleHit reversed = hit_of(shear, origin, a, c, b);
        ASSERT_EQ(h.hit, reversed.hit);
        if (h.hit) {
            EXPECT_FLOAT_EQ(h.u, reversed.v);
            EXPECT_FLOAT_EQ(h.v, reversed.u);
        }
    }
}

TEST(Triangle, RangeIncludesItsEnds) {
    const RayShear shear = ray_shear(vec3(0, 0, 1));
    const vec3 o(0.25f, 0.25f, 0);
    const vec3 a(0, 0, 2);
    const vec3 b(1, 0, 2);
    const vec3 c(0, 1, 2);
    EXPECT_TRUE(hit_of(shear, o, a, b, c, 2, 2).hit);
    EXPECT_FALSE(hit_of(shear, o, a, b, c, 0, 1.9999999f).hit);
    EXPECT_FALSE(hit_of(shear, o, a, b, c, 2.0000002f, 9).hit);
    // t is in units of the direction's length.
    EXPECT_EQ(hit_of(ray_shear(vec3(0, 0, 4)), o, a, b, c).t, 0.5f);
    EXPECT_FALSE(hit_of(ray_shear(vec3(0, 0, -1)), o, a, b, c).hit);
    const TriangleHit h = hit_of(shear, vec3(0.5f, 0.25f, 1), a, b, c);
    EXPECT_EQ(h.t, 1.0f);
    EXPECT_EQ(h.u, 0.5f);
    EXPECT_EQ(h.v, 0.25f);
}

// From inside a closed mesh every ray hits something, at whatever it is aimed, wherever the mesh
// is, and however large it is.
TEST(Triangle, ClosedMeshIsWatertight) {
    std::mt19937 bits(3);
    for (const float scale : {1e-12f, 1e-6f, 1.0f, 1e6f, 1e12f}) {
        for (const float bumps : {0.0f, 0.3f}) {
            Mesh mesh = closed_mesh(3, bumps, bits);
            std::uniform_real_distribution<float> uniform;
            const vec3 center = bumps > 0 ? vec3(3, -2, 7) * uniform(bits) : vec3(0);
            for (vec3& v : mesh.vertices) {
                v = (v + center) * scale;
            }
            for (int i = 0; i < 1500; ++i) {
                const vec3 origin = (center + 0.2f * uniform(bits) * any_direction(bits)) * scale;
                const auto& target = mesh.triangles[bits() % mesh.triangles.size()];
                const vec3 a = mesh.vertices[target[0]];
                const vec3 b = mesh.vertices[target[1]];
                vec3 direction = a - origin; // towards a vertex
                if (i % 3 == 1) {            // towards an edge
                    direction = (a + (b - a) * uniform(bits)) - origin;
                }
                direction = i % 2 == 0 ? direction : glm::normalize(direction / scale);
                const RayShear shear = ray_shear(direction);
                int hits = 0;
                for (const auto& [p, q, r] : mesh.triangles) {
                    hits +=
                        hit_of(shear, origin, mesh.vertices[p], mesh.vertices[q], mesh.vertices[r])
                            .hit;
                }
                ASSERT_GT(hits, 0) << "scale " << scale << ", case " << i;
            }
        }
    }
}

// Rays along the axes and diagonals of a grid run exactly through its edges and vertices.
TEST(Triangle, GridIsWatertightForAxisParallelRays) {
    for (const float scale : {1e-6f, 1.0f, 1e6f}) {
        for (int x = -3; x <= 3; ++x) {
            for (int y = -3; y <= 3; ++y) {
                for (const vec3 direction :
                     {vec3(0, 0, -1), vec3(1, 0, -1), vec3(0, -1, -1), vec3(1, 1, -1)}) {
                    // Multiples of 1/2: points on edges, on vertices, or on diagonals of the cells.
                    const vec3 through = vec3(0.5f * float(x), 0.5f * float(y), 0);
                    const vec3 origin = (through - direction * 3.0f) * scale;
                    const RayShear shear = ray_shear(direction);
                    int hits = 0;
                    for (int i = -4; i < 4; ++i) {
                        for (int j = -4; j < 4; ++j) {
                            const vec3 a = vec3(i, j, 0) * scale;
                            const vec3 b = vec3(i + 1, j, 0) * scale;
                            const vec3 c = vec3(i + 1, j + 1, 0) * scale;
                            const vec3 d = vec3(i, j + 1, 0) * scale;
                            for (const TriangleHit& h :
                                 {hit_of(shear, origin, a, b, c), hit_of(shear, origin, a, c, d)}) {
                                hits += h.hit;
                                if (h.hit) {
                                    EXPECT_NEAR(h.t / scale, 3, 3e-6);
                                }
                            }
                        }
                    }
                    ASSERT_GT(hits, 0);
                }
            }
        }
    }
}

TEST(Triangle, ScaleByAPowerOfTwoChangesNothing) {
    std::mt19937 bits(5);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 20'000; ++i) {
        vec3 v[4];
        for (vec3& p : v) {
            p = vec3(normal(bits), normal(bits), normal(bits));
        }
        const RayShear shear = ray_shear(any_direction(bits));
        const TriangleHit h = hit_of(shear, v[3], v[0], v[1], v[2]);
        for (const float scale : {0x1p-40f, 0x1p40f}) {
            const TriangleHit k =
                hit_of(shear, v[3] * scale, v[0] * scale, v[1] * scale, v[2] * scale);
            ASSERT_EQ(h.hit, k.hit);
            ASSERT_EQ(h.u, k.u);
            ASSERT_EQ(h.v, k.v);
            ASSERT_EQ(h.t * scale, k.t);
        }
    }
}

TEST(Triangle, DegenerateTrianglesAreMissed) {
    std::mt19937 bits(4);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 1000; ++i) {
        const vec3 direction = any_direction(bits);
        const RayShear shear = ray_shear(direction);
        const vec3 p = direction * 2.0f;
        const vec3 q = p + any_direction(bits);
        EXPECT_FALSE(hit_of(shear, vec3(0), p, p, p).hit);
        EXPECT_FALSE(hit_of(shear, vec3(0), p, q, q).hit);
        EXPECT_FALSE(hit_of(shear, vec3(0), q, p, q).hit);
        EXPECT_FALSE(hit_of(shear, vec3(0), p, q, vec3(nan, 0, 0)).hit);
        EXPECT_FALSE(hit_of(shear, vec3(0), vec3(0, infinity, 0), p, q).hit);
    }
    // Edge-on.
    EXPECT_FALSE(hit_of(ray_shear(vec3(1, 0, 0)), vec3(-1, 0, 0), vec3(0, 0, 0), vec3(1, 1, 0),
                        vec3(1, -1, 0))
                     .hit);
}

} // namespace
} // namespace argand
