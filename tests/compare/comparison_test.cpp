#include "compare/comparison.hpp"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace argand {
namespace {

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

StageComparison compare(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b,
                        const char* layout) {
    StageComparison result;
    compare_items(a, b, layout, 1e-3, result);
    return result;
}

TEST(Comparison, EqualItemsAreOnlyCounted) {
    const std::vector<std::uint32_t> words{bits(1), 7, bits(NAN), 8};
    const StageComparison found = compare(words, words, "fu");
    EXPECT_EQ(found.items, 2u);
    EXPECT_EQ(found.unequal, 0u);
    EXPECT_EQ(found.diverged, 0u);
    EXPECT_EQ(compare({}, {}, "f").items, 0u);
}

TEST(Comparison, NeighbouringFloatsAreOneUlpApart) {
    const float next = std::nextafter(3.0f, 4.0f);
    const StageComparison found = compare({bits(3), bits(1)}, {bits(next), bits(1)}, "f");
    EXPECT_EQ(found.items, 2u);
    EXPECT_EQ(found.unequal, 1u);
    EXPECT_EQ(found.diverged, 0u);
    EXPECT_EQ(found.largest_ulp, 1u);
    EXPECT_NEAR(found.largest_relative, (next - 3.0) / next, 1e-12);
}

TEST(Comparison, ZerosOfEitherSignAndTheSmallestNumbersAreNeighbours) {
    const float least = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(compare({bits(0.0f)}, {bits(-0.0f)}, "f").largest_ulp, 0u);
    EXPECT_EQ(compare({bits(0.0f)}, {bits(-0.0f)}, "f").diverged, 0u);
    EXPECT_EQ(compare({bits(0.0f)}, {bits(-0.0f)}, "f").unequal, 0u);
    // A small value may be off by a share of the same word's largest value in other items, but not
    // of other words in its item.
    EXPECT_EQ(compare({bits(1), bits(least)}, {bits(1), bits(-least)}, "f").largest_ulp, 2u);
    EXPECT_EQ(compare({bits(1), bits(least)}, {bits(1), bits(-least)}, "ff").diverged, 1u);
    EXPECT_EQ(compare({bits(500), bits(2e-4f)}, {bits(500), bits(1e-4f)}, "ff").diverged, 1u);
}

TEST(Comparison, DifferentIntegersAndDistantFloatsDiverge) {
    EXPECT_EQ(compare({5, bits(1)}, {6, bits(1)}, "uf").diverged, 1u);
    EXPECT_EQ(compare({bits(1)}, {bits(1.01f)}, "f").diverged, 1u);
    EXPECT_EQ(compare({bits(1)}, {bits(1.0005f)}, "f").diverged, 0u);
    EXPECT_EQ(compare({bits(1)}, {bits(-1)}, "f").diverged, 1u);
    EXPECT_EQ(compare({bits(1)}, {bits(INFINITY)}, "f").diverged, 1u);
    EXPECT_EQ(compare({bits(1)}, {bits(NAN)}, "f").diverged, 1u);
}

TEST(Comparison, DivergedItemsDoNotCountInTheLargestError) {
    const StageComparison found = compare({bits(1), bits(2)}, {bits(100), bits(2)}, "f");
    EXPECT_EQ(found.diverged, 1u);
    EXPECT_EQ(found.largest_ulp, 0u);
    EXPECT_EQ(found.largest_relative, 0.0);
}

} // namespace
} // namespace argand
