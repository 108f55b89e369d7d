#include "shared/fixed_point.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace argand {
namespace {

std::uint64_t joined(uvec2 a) { return std::uint64_t{a.y} << 32 | a.x; }
uvec2 split(std::uint64_t a) { return {static_cast<uint>(a), static_cast<uint>(a >> 32)}; }

TEST(FixedPoint, AddsModulo64Bits) {
    std::mt19937_64 bits(2);
    for (int i = 0; i < 100'000; ++i) {
        // Small numbers and full low words, so that carries are frequent.
        const std::uint64_t a = bits() | (i % 3 == 0 ? 0xffffffffu : 0u);
        const std::uint64_t b = i % 2 == 0 ? bits() : bits() % 4;
        ASSERT_EQ(joined(fixed_add(split(a), split(b))), a + b);
    }
}

TEST(FixedPoint, SubtractsComparesAndDivides) {
    std::mt19937_64 bits(3);
    for (int i = 0; i < 100'000; ++i) {
        const std::uint64_t a = bits() >> (1 + bits() % 63);
        const std::uint64_t b = i % 5 == 0 ? a : bits() >> (1 + bits() % 63);
        ASSERT_EQ(joined(fixed_subtract(split(a), split(b))), a - b);
        ASSERT_EQ(fixed_less(split(a), split(b)), a < b);
        if (a < b) {
            const auto ratio =
                static_cast<std::uint64_t>((__extension__(unsigned __int128)(a) << 32) / b);
            ASSERT_EQ(fixed_ratio(split(a), split(b)), ratio) << a << " / " << b;
        } else {
            ASSERT_EQ(fixed_ratio(split(a), split(b)), 0xffffffffu);
        }
    }
}

TEST(FixedPoint, IsRoundedDownFromFloats) {
    std::mt19937_64 bits(4);
    for (int i = 0; i < 100'000; ++i) {
        const auto x = bits_float(static_cast<uint>(bits() % 0x7f800000u));
        // So that x 2^scale is between 2^-30 and 2^63.
        const int scale = static_cast<int>(bits() % 93) - 30 - std::ilogb(x);
        ASSERT_EQ(joined(fixed_from_float(x, scale)),
                  static_cast<std::uint64_t>(std::ldexp(double(x), scale)))
            << x << ", " << scale;
    }
    EXPECT_EQ(joined(fixed_from_float(0, 10)), 0u);
}

} // namespace
} // namespace argand
