#include "shared/cube_map.h"

#include <gtest/gtest.h>
#include <random>

namespace argand {
namespace {

TEST(CubeMap, EveryTexelLiesInItsOwnDirection) {
    for (const uint size : {1u, 2u, 7u, 128u}) {
        for (uint texel = 0; texel < cube_texels(size); ++texel) {
            ASSERT_EQ(cube_texel(cube_direction(texel, size), size), texel) << size;
        }
    }
}

TEST(CubeMap, DirectionsOfAnyLengthLieInATexel) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 100'000; ++i) {
        const vec3 direction(normal(random), normal(random), normal(random));
        for (const float scale : {1e-18f, 1.0f, 1e18f}) {
            ASSERT_LT(cube_texel(scale * direction, 31), cube_texels(31));
            ASSERT_EQ(cube_texel(scale * direction, 31), cube_texel(direction, 31));
        }
    }
    for (const vec3& edge : {vec3(1, 1, 1), vec3(-1, 1, -1), vec3(0, -1, 1), vec3(1, 0, 0)}) {
        EXPECT_LT(cube_texel(edge, 31), cube_texels(31));
    }
}

TEST(CubeMap, NeighboursAreOneTexelAwayOnTheSameFace) {
    constexpr uint size = 16;
    for (uint row = 1; row + 1 < size; ++row) {
        for (uint column = 1; column + 1 < size; ++column) {
            const uint texel = (3 * size + row) * size + column;
            const vec3 direction = 5.0f * cube_direction(texel, size);
            EXPECT_EQ(cube_texel(cube_neighbour(direction, vec2(1, 0), size), size), texel + 1);
            EXPECT_EQ(cube_texel(cube_neighbour(direction, vec2(0, -1), size), size), texel - size);
        }
    }
}

TEST(CubeMap, NeighboursBeyondAnEdgeLieOnTheNextFace) {
    constexpr uint size = 16;
    const vec3 last = cube_direction(size - 1, size); // of the first row towards +x
    const uint beyond = cube_texel(cube_neighbour(last, vec2(1, 0), size), size);
    EXPECT_NE(beyond / (size * size), 0u);
    const vec3 there = cube_direction(beyond, size);
    EXPECT_GT(dot3(last, there) / std::sqrt(dot3(last, last) * dot3(there, there)), 0.95f);
}

} // namespace
} // namespace argand
