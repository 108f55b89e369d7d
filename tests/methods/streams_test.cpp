#include "session/streams.hpp"

#include <gtest/gtest.h>
#include <set>
#include <tuple>

namespace argand {
namespace {

TEST(Streams, PassesOfAStreamCountUpAndOfOthersHaveOtherSeeds) {
    Streams streams(7);
    for (std::uint64_t i = 0; i < 3; ++i) {
        const PassNumbers numbers = streams.next(0, 1000);
        EXPECT_EQ(numbers.seed, 7u);
        EXPECT_EQ(numbers.index, i);
    }
    const PassNumbers other = streams.next(1, 1000);
    EXPECT_NE(other.seed, 7u);
    EXPECT_EQ(other.index, 0u);
    EXPECT_EQ(streams.next(0, 1000).index, 3u);
}

TEST(Streams, GoOnWithAnotherSeedWhereTheNumbersOfOneEnd) {
    Streams streams(0);
    std::set<std::tuple<std::uint32_t, std::uint64_t>> seen;
    std::set<std::uint32_t> seeds;
    for (int pass = 0; pass < 3000; ++pass) {
        for (const std::uint32_t stream : {0u, 1u}) {
            const PassNumbers numbers = streams.next(stream, 3);
            EXPECT_LT(numbers.index, 3u);
            EXPECT_TRUE(seen.emplace(numbers.seed, numbers.index).second) << pass;
            seeds.insert(numbers.seed);
        }
    }
    EXPECT_EQ(seeds.size(), 2000u);
}

TEST(Streams, OfOnePassPerSeedStillDiffer) {
    Streams streams(0);
    EXPECT_NE(streams.next(0, 1).seed, streams.next(0, 1).seed);
}

} // namespace
} // namespace argand
