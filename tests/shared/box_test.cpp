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

struct BoxHit {
    bool hit;
    float tnear;
};
BoxHit meets(vec3 origin, vec3 direction, vec3 low, vec3 high, float tmax = 3e38f) {
    BoxHit result{};
    const RaySlabs slabs = ray_slabs(origin, direction, box_reach(origin, low, high));
    result.hit = intersect_box(slabs, low, high, tmax, result.tnear);
    return result;
}

TEST(Box, IsMetFromOutsideAndInside) {
    const vec3 low(-1);
    const vec3 high(1);
    EXPECT_TRUE(meets(vec3(-3, 0, 0), vec3(1, 0, 0), low, high).hit);
    EXPECT_NEAR(meets(vec3(-3, 0, 0), vec3(1, 0, 0), low, high).tnear, 2, 1e-5);
    EXPECT_TRUE(meets(vec3(0.5f), vec3(0, -1, 0), low, high).hit);
    EXPECT_EQ(meets(vec3(0.5f), vec3(0, -1, 0), low, high).tnear, 0.0f);
    EXPECT_FALSE(meets(vec3(-3, 0, 0), vec3(-1, 0, 0), low, high).hit);
    EXPECT_FALSE(meets(vec3(-3, 1.001f, 0), vec3(1, 0, 0), low, high).hit);
    EXPECT_FALSE(meets(vec3(-3, 0, 0), vec3(1, 0, 0), low, high, 1.999f).hit);
    EXPECT_TRUE(meets(vec3(-3, 0, 0), vec3(1, 0, 0), low, high, 2).hit);
}

// Zero components of the direction, of both signs, with the origin in the very planes of the sides.
TEST(Box, RaysInTheSidesPlanesMeetIt) {
    for (const float scale : {1e-12f, 1e-6f, 1.0f, 1e6f, 1e12f}) {
        for (const float zero : {0.0f, -0.0f}) {
            for (const float x : {-1.0f, -0.5f, 1.0f}) {
                for (const float y : {-1.0f, 0.5f, 1.0f}) {
                    for (int axis = 0; axis < 3; ++axis) {
                        vec3 origin(x, y, -5);
                        vec3 direction(zero, zero, 1);
                        for (int turn = 0; turn < axis; ++turn) {
                            origin = vec3(origin.z, origin.x, origin.y);
                            direction = vec3(direction.z, direction.x, direction.y);
                        }
                        EXPECT_TRUE(meets(origin * scale, direction, vec3(-scale), vec3(scale)).hit);
                        EXPECT_TRUE(meets(-origin * scale, -direction, vec3(-scale), vec3(scale)).hit);
                        EXPECT_FALSE(meets(origin * scale, -direction, vec3(-scale), vec3(scale)).hit);
                        EXPECT_FALSE(meets(origin * 1.1f * scale, direction, vec3(-scale), vec3(scale)).hit ==
                                     (std::abs(x) == 1 || std::abs(y) == 1));
                    }
                }
            }
        }
    }
}

TEST(Box, FlatAndPointBoxesAreMet) {
    EXPECT_TRUE(meets(vec3(0, 0, -1), vec3(0, 0, 1), vec3(-1, -1, 0), vec3(1, 1, 0)).hit);
    EXPECT_TRUE(meets(vec3(-2, 0, 0), vec3(1, 0, 0), vec3(-1, -1, 0), vec3(1, 1, 0)).hit); // in its plane
    EXPECT_TRUE(meets(vec3(-2, 0, 0), vec3(1, 0, 0), vec3(0), vec3(0)).hit);
    const vec3 p(0.3f, 0.7f, -0.2f);
    EXPECT_TRUE(meets(vec3(0), glm::normalize(p), p, p).hit);
}

// Whatever triangle is hit, its box is met, at a distance that is not larger: for rays at vertices and edges,
// at all scales, far from the world's origin, nearly parallel to axes.
TEST(Box, IsMetWhereverItsTriangleIsHit) {
    std::mt19937 bits(1);
    std::uniform_real_distribution<float> uniform;
    int hits = 0;
    for (const float scale : {1e-12f, 1e-6f, 1.0f, 1e6f, 1e12f}) {
        for (const float far : {0.0f, 10.0f, 10'000.0f}) {
            Mesh mesh = closed_mesh(3, 0.3f, bits);
            const vec3 center = far * any_direction(bits);
            vec3 scene_low(std::numeric_limits<float>::max());
            vec3 scene_high(-std::numeric_limits<float>::max());
            for (vec3& v : mesh.vertices) {
                v = (v + center) * scale;
                scene_low = glm::min(scene_low, v);
                scene_high = glm::max(scene_high, v);
            }
            for (int i = 0; i < 400; ++i) {
                const vec3 origin = (center + 0.2f * uniform(bits) * any_direction(bits)) * scale;
                const auto& target = mesh.triangles[bits() % mesh.triangles.size()];
                const vec3 a = mesh.vertices[target[0]];
                const vec3 b = mesh.vertices[target[1]];
                vec3 direction =
                    glm::normalize(((i % 2 == 0 ? a : a + (b - a) * uniform(bits)) - origin) / scale);
                if (i % 5 == 0) {
                    direction[i % 3] *= testing::any_magnitude(bits, -140, 0);
                    direction = glm::normalize(direction);
                }
                const RayShear shear = ray_shear(direction);
                const RaySlabs slabs = ray_slabs(origin, direction, box_reach(origin, scene_low, scene_high));
                for (const auto& [p, q, r] : mesh.triangles) {
                    const vec3 v0 = mesh.vertices[p];
                    const vec3 v1 = mesh.vertices[q];
                    const vec3 v2 = mesh.vertices[r];
                    const TriangleHit h = hit_of(shear, origin, v0, v1, v2);
                    if (!h.hit) {
                        continue;
                    }
                    ++hits;
                    float tnear = 0;
                    ASSERT_TRUE(intersect_box(slabs, glm::min(v0, glm::min(v1, v2)),
                                              glm::max(v0, glm::max(v1, v2)), h.t, tnear))
                        << scale << " " << far << " " << i;
                    ASSERT_LE(tnear, h.t * 1.000001f);
                }
            }
        }
    }
    EXPECT_GT(hits, 6000);
}

// Against exact arithmetic on random rays: never wrongly missed, and hardly larger than it is.
TEST(Box, AgreesWithDoublePrecision) {
    std::mt19937 bits(2);
    std::normal_distribution<float> normal;
    int wrongly_met = 0;
    for (int i = 0; i < 300'000; ++i) {
        const vec3 a(normal(bits), normal(bits), normal(bits));
        const vec3 b(normal(bits), normal(bits), normal(bits));
        const vec3 low = glm::min(a, b);
        const vec3 high = glm::max(a, b);
        const vec3 origin = 2.0f * vec3(normal(bits), normal(bits), normal(bits));
        const vec3 direction = any_direction(bits);
        double near = 0;
        double far = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 3; ++k) {
            const double t0 = (double(low[k]) - origin[k]) / direction[k];
            const double t1 = (double(high[k]) - origin[k]) / direction[k];
            near = std::max(near, std::min(t0, t1));
            far = std::min(far, std::max(t0, t1));
        }
        const BoxHit h = meets(origin, direction, low, high);
        if (near <= far) {
            ASSERT_TRUE(h.hit);
            ASSERT_LE(h.tnear, near * 1.000001 + 1e-6);
        }
        wrongly_met += h.hit && near > far;
    }
    EXPECT_LT(wrongly_met, 10);
}

} // namespace
} // namespace argand
