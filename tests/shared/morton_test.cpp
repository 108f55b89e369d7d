#include "numbers.hpp"
#include "shared/morton.h"

#include <gtest/gtest.h>

namespace argand {
namespace {

const float nan = std::numeric_limits<float>::quiet_NaN();
const float infinity = std::numeric_limits<float>::infinity();

/// Reference implementation, bit by bit.
std::uint64_t interleaved(std::uint64_t x, std::uint64_t y, std::uint64_t z, int bits) {
    std::uint64_t code = 0;
    for (int bit = bits - 1; bit >= 0; --bit) {
        code = code << 3 | (x >> bit & 1) << 2 | (y >> bit & 1) << 1 | (z >> bit & 1);
    }
    return code;
}

TEST(Morton, InterleavesTheCells) {
    std::mt19937 bits(1);
    const vec3 low(0);
    const vec3 high(1);
    for (int i = 0; i < 100'000; ++i) {
        const vec3 p(float(bits() >> 8) * 0x1p-24f, float(bits() >> 8) * 0x1p-24f,
                     float(bits() >> 8) * 0x1p-24f);
        const auto cell = [](float x, double cells) {
            return static_cast<std::uint64_t>(double(x) * cells);
        };
        ASSERT_EQ(morton30(p, low, high),
                  interleaved(cell(p.x, 1024), cell(p.y, 1024), cell(p.z, 1024), 10));
    }
}

TEST(Morton, CornersAreFirstAndLast) {
    for (const float scale : {1e-30f, 1.0f, 1e30f}) {
        const vec3 low = vec3(-1, 2, 3) * scale;
        const vec3 high = vec3(5, 6, 7) * scale;
        EXPECT_EQ(morton30(low, low, high), 0u);
        EXPECT_EQ(morton30(high, low, high), (1u << 30) - 1);
    }
}

TEST(Morton, CellsAreMonotonic) {
    std::mt19937 bits(2);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (int i = 0; i < 100'000; ++i) {
        const float scale = testing::any_magnitude(bits, -120, 120);
        const float a = uniform(bits) * scale;
        const float b = uniform(bits) * scale;
        ASSERT_LE(morton_cell(std::min(a, b), -scale, scale, 1024.0f),
                  morton_cell(std::max(a, b), -scale, scale, 1024.0f));
    }
}

TEST(Morton, AnyInputGivesACodeInRange) {
    const vec3 low(-1);
    const vec3 high(1);
    for (const float x : {nan, infinity, -infinity, 3e38f, -3e38f, 2.0f, -2.0f}) {
        EXPECT_LT(morton30(vec3(x), low, high), 1u << 30);
    }
    EXPECT_EQ(morton30(vec3(nan), low, high), 0u);
    EXPECT_EQ(morton30(vec3(-infinity), low, high), 0u);
    EXPECT_EQ(morton30(vec3(infinity), low, high), (1u << 30) - 1);
    EXPECT_EQ(morton30(vec3(5), low, high), (1u << 30) - 1);
    // Empty extent, inverted bounds, or NaN.
    EXPECT_EQ(morton30(vec3(1), vec3(1), vec3(1)), 0u);
    EXPECT_EQ(morton30(vec3(0), vec3(1), vec3(-1)), 0u);
    EXPECT_EQ(morton30(vec3(0), vec3(nan), vec3(1)), 0u);
    EXPECT_EQ(morton30(vec3(0), vec3(-1), vec3(nan)), 0u);
    // A flat axis does not affect the others.
    EXPECT_EQ(morton30(vec3(1, 0, 1), vec3(-1, 0, -1), vec3(1, 0, 1)),
              interleaved(1023, 0, 1023, 10));
    // An extent that overflows single precision.
    EXPECT_EQ(morton_cell(0.0f, -3e38f, 3e38f, 1024.0f), 512u);
    EXPECT_EQ(morton_cell(3e38f, -3e38f, 3e38f, 1024.0f), 1023u);
}

TEST(Morton, LeadingZerosAreCounted) {
    EXPECT_EQ(leading_zeros(0), 32u);
    std::mt19937 bits(3);
    for (int bit = 0; bit < 32; ++bit) {
        EXPECT_EQ(leading_zeros(1u << bit), 31u - bit);
        EXPECT_EQ(leading_zeros((1u << bit) | (static_cast<uint>(bits()) & ((1u << bit) - 1))),
                  31u - bit);
    }
}

TEST(Morton, DistanceIsTheHighestDifferingBit) {
    // 30-bit codes are in the high word. Places tell equal codes apart.
    EXPECT_EQ(code_distance({0, 0x80000000u}, 3, {0, 0x80000001u}, 3), 64u);
    EXPECT_EQ(code_distance({0, 0x80000000u}, 3, {0, 0}, 4), 95u);
    EXPECT_EQ(code_distance({7, 5}, 3, {6, 5}, 4), 32u);
    EXPECT_EQ(code_distance({0x80000000u, 5}, 3, {6, 5}, 4), 63u);
    EXPECT_EQ(code_distance({7, 5}, 0, {7, 5}, 1), 0u);
    EXPECT_EQ(code_distance({7, 5}, 0, {7, 5}, 0x80000000u), 31u);
    EXPECT_LT(code_distance({0, 0x80000000u}, 3, {0, 0}, 4), no_neighbour);
}

TEST(Morton, Codes63Have21BitsPerAxis) {
    std::mt19937 bits(5);
    for (int i = 0; i < 10'000; ++i) {
        const uint x = uint(bits()) & 0x1fffffu;
        const uint y = uint(bits()) & 0x1fffffu;
        const uint z = uint(bits()) & 0x1fffffu;
        const uvec2 code = morton63(vec3(x, y, z) + 0.25f, vec3(0), vec3(2097152));
        EXPECT_EQ(std::uint64_t(code.y) << 32 | code.x, interleaved(x, y, z, 21));
    }
    EXPECT_EQ(morton63(vec3(5), vec3(-1), vec3(1)), uvec2(0xffffffffu, 0x7fffffffu));
    EXPECT_EQ(morton63(vec3(std::numeric_limits<float>::quiet_NaN()), vec3(-1), vec3(1)), uvec2(0));
}

} // namespace
} // namespace argand
