#include "shared/fixed_point.h"

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

} // namespace
} // namespace argand
