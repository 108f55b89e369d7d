#include "numbers.hpp"
#include "shared/fixed_point.h"

#include <gtest/gtest.h>

namespace argand {
namespace {

using testing::any_finite;
using testing::any_magnitude;

std::uint64_t joined(uvec2 a) {
    return std::uint64_t{a.y} << 32 | a.x;
}
uvec2 split(std::uint64_t a) {
    return {static_cast<uint>(a), static_cast<uint>(a >> 32)};
}

/// By arithmetic that is exact: x 2^bits fits long double's 64 bits wherever it is below 2^64.
std::uint64_t units(float x, int bits) {
    if (!(x > 0)) {
        return 0;
    }
    const long double scaled = std::ldexp(static_cast<long double>(x), bits);
    return scaled >= 0x1p64L ? ~std::uint64_t{0} : static_cast<std::uint64_t>(scaled);
}

TEST(FixedPoint, ConvertsExactly) {
    std::mt19937 bits(1);
    for (int i = 0; i < 300'000; ++i) {
        const float x = i % 2 == 0 ? any_finite(bits) : any_magnitude(bits, -40, 70);
        const int fraction = int(bits() % 253) - 126;
        ASSERT_EQ(joined(fixed_from_float(x, fraction)), units(x, fraction)) << x << " " << fraction;
        ASSERT_EQ(joined(fixed_from_float(x, 30)), units(x, 30)) << x;
    }
    for (int exponent = -149; exponent < 128; ++exponent) { // each shift, with all bits of the mantissa set
        const float x = std::nextafter(std::ldexp(1.0f, exponent + 1), 0.0f);
        for (const int fraction : {-126, -10, 0, 20, 126}) {
            ASSERT_EQ(joined(fixed_from_float(x, fraction)), units(x, fraction)) << x << " " << fraction;
        }
    }
}

TEST(FixedPoint, WhatIsNoNumberIsZeroAndWhatIsTooLargeIsTheLargest) {
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(joined(fixed_from_float(infinity, 0)), ~std::uint64_t{0});
    EXPECT_EQ(joined(fixed_from_float(infinity, -126)), ~std::uint64_t{0});
    EXPECT_EQ(joined(fixed_from_float(3e38f, 0)), ~std::uint64_t{0});
    EXPECT_EQ(joined(fixed_from_float(-infinity, 0)), 0u);
    EXPECT_EQ(joined(fixed_from_float(-1, 0)), 0u);
    EXPECT_EQ(joined(fixed_from_float(-0.0f, 0)), 0u);
    EXPECT_EQ(joined(fixed_from_float(std::numeric_limits<float>::quiet_NaN(), 0)), 0u);
}

TEST(FixedPoint, AddsModulo64Bits) {
    std::mt19937_64 bits(2);
    for (int i = 0; i < 100'000; ++i) {
        // Few high bits, so that words are often full.
        const std::uint64_t a = bits() | (i % 3 == 0 ? 0xffffffffu : 0u);
        const std::uint64_t b = i % 2 == 0 ? bits() : bits() % 4;
        ASSERT_EQ(joined(fixed_add(split(a), split(b))), a + b);
        ASSERT_EQ(joined(fixed_negate(split(a))), 0 - a);
    }
    EXPECT_EQ(joined(fixed_negate(split(0))), 0u);
}

TEST(FixedPoint, SumsDoNotDependOnTheOrder) {
    std::mt19937 bits(3);
    std::vector<float> terms(10'000);
    for (float& term : terms) {
        term = any_magnitude(bits, -30, 20);
    }
    const auto sum = [&] {
        uvec2 total(0, 0);
        for (const float term : terms) {
            total = fixed_add(total, fixed_from_float(term, 32));
        }
        return joined(total);
    };
    const std::uint64_t forwards = sum();
    std::shuffle(terms.begin(), terms.end(), bits);
    EXPECT_EQ(sum(), forwards);
}

TEST(FixedPoint, ThereAndBack) {
    std::mt19937 bits(4);
    for (int i = 0; i < 100'000; ++i) {
        const float x = any_magnitude(bits, -7, 30); // 24 bits, above units of 2^-31
        const uvec2 fixed = fixed_from_float(x, 31);
        ASSERT_EQ(fixed_to_real(fixed, 31), x);
        ASSERT_EQ(fixed_to_real_signed(fixed, 31), x);
        ASSERT_EQ(fixed_to_real_signed(fixed_negate(fixed), 31), -x);
    }
    EXPECT_EQ(fixed_to_real(split(~std::uint64_t{0}), 0), 0x1p64f);
    EXPECT_EQ(fixed_to_real(split(1), -100), 0x1p100f);
}

} // namespace
} // namespace argand
