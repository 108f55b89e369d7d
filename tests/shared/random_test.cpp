#include "shared/random.h"
#include "statistics.hpp"

#include <bit>
#include <gtest/gtest.h>
#include <set>

namespace argand {
namespace {

using testing::chi_square_deviations;
using testing::unlikely;

TEST(Random, UnitNumbersStayBelowOne) {
    EXPECT_EQ(to_unit(0u), 0.0f);
    EXPECT_EQ(to_unit(0xffu), 0.0f);
    EXPECT_EQ(to_unit(0x100u), 0x1p-24f);
    EXPECT_EQ(to_unit(0x80000000u), 0.5f);
    EXPECT_EQ(to_unit(0xffffffffu), 1 - 0x1p-24f);
    EXPECT_LT(to_unit(0xffffffffu), 1.0f);
}

// The paper's hash, implemented independently, lane by lane in 64 bits.
TEST(Random, HashIsPcg4d) {
    std::uint64_t counter = 0;
    for (int i = 0; i < 1000; ++i) {
        std::uint32_t in[4];
        for (std::uint32_t& word : in) {
            counter = counter * 6364136223846793005u + 1442695040888963407u;
            word = static_cast<std::uint32_t>(counter >> 32);
        }
        std::uint64_t v[4];
        const auto wrap = [&](int to, int a, int b) {
            v[to] = (v[to] + v[a] * v[b]) & 0xffffffffu;
        };
        for (int k = 0; k < 4; ++k) {
            v[k] = (in[k] * std::uint64_t{1664525} + 1013904223u) & 0xffffffffu;
        }
        wrap(0, 1, 3), wrap(1, 2, 0), wrap(2, 0, 1), wrap(3, 1, 2);
        for (std::uint64_t& word : v) {
            word ^= word >> 16;
        }
        wrap(0, 1, 3), wrap(1, 2, 0), wrap(2, 0, 1), wrap(3, 1, 2);
        const uvec4 hash = pcg4d(uvec4(in[0], in[1], in[2], in[3]));
        EXPECT_EQ(hash, uvec4(v[0], v[1], v[2], v[3]));
    }
}

TEST(Random, NumbersDependOnEveryArgument) {
    const vec4 a = random4(1, 2, 3, 4);
    EXPECT_EQ(a, random4(1, 2, 3, 4));
    EXPECT_NE(a, random4(2, 2, 3, 4));
    EXPECT_NE(a, random4(1, 3, 3, 4));
    EXPECT_NE(a, random4(1, 2, 4, 4));
    EXPECT_NE(a, random4(1, 2, 3, 5));
}

TEST(Random, LanesAreUniform) {
    std::vector<std::vector<double>> counts(4, std::vector<double>(256));
    for (std::uint32_t i = 0; i < 400'000; ++i) {
        const vec4 u = random4(7, i, 0, 0);
        for (int lane = 0; lane < 4; ++lane) {
            ASSERT_GE(u[lane], 0.0f);
            ASSERT_LT(u[lane], 1.0f);
            ++counts[lane][static_cast<std::size_t>(u[lane] * 256)];
        }
    }
    for (const auto& lane : counts) {
        EXPECT_LT(chi_square_deviations(lane), unlikely);
    }
}

// Neighbours in any argument, and any two lanes, fill the square evenly.
TEST(Random, NeighboursAreIndependent) {
    for (int kind = 0; kind < 4; ++kind) {
        std::vector<std::vector<double>> counts(16, std::vector<double>(16 * 16));
        for (std::uint32_t i = 0; i < 60'000; ++i) {
            const std::uint32_t k = i % 64;
            const vec4 a =
                random4(kind == 0 ? i : 3, kind == 1 ? i : k, kind == 2 ? i : 5, kind == 3 ? i : 1);
            const vec4 b = random4(kind == 0 ? i + 1 : 3, kind == 1 ? i + 1 : k,
                                   kind == 2 ? i + 1 : 5, kind == 3 ? i + 1 : 1);
            for (int pair = 0; pair < 16; ++pair) {
                const auto x = static_cast<std::size_t>(a[pair / 4] * 16);
                const auto y = static_cast<std::size_t>(b[pair % 4] * 16);
                ++counts[pair][x * 16 + y];
            }
        }
        for (int pair = 0; pair < 16; ++pair) {
            EXPECT_LT(chi_square_deviations(counts[pair]), unlikely)
                << "kind " << kind << ", pair " << pair;
        }
    }
}

TEST(Random, OneBitOfTheCounterChangesHalfOfTheBits) {
    for (int word = 0; word < 4; ++word) {
        for (int bit = 0; bit < 32; ++bit) {
            double changed = 0;
            const int tries = 500;
            for (int i = 0; i < tries; ++i) {
                uvec4 v(i, 2 * i + 1, 3, 11 * i);
                const vec4 before = random4(v.w, v.x, v.y, v.z) * 0x1p24f;
                v[word] ^= 1u << bit;
                const vec4 after = random4(v.w, v.x, v.y, v.z) * 0x1p24f;
                for (int lane = 0; lane < 4; ++lane) {
                    changed += std::popcount(static_cast<std::uint32_t>(before[lane]) ^
                                             static_cast<std::uint32_t>(after[lane]));
                }
            }
            EXPECT_NEAR(changed / (tries * 96), 0.5, 0.02) << "word " << word << ", bit " << bit;
        }
    }
}

TEST(Random, CountersDoNotCollide) {
    std::set<std::uint64_t> seen;
    for (std::uint32_t i = 0; i < 100'000; ++i) {
        const uvec4 hash = pcg4d(uvec4(i % 1000, i / 1000, 0, 1));
        seen.insert(std::uint64_t{hash.x} << 32 | hash.y);
    }
    EXPECT_EQ(seen.size(), 100'000u);
}

} // namespace
} // namespace argand
