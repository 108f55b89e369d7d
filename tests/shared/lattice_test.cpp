#include "shared/lattice.h"
#include "shared/sampling.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace argand {
namespace {

// The definition, in exact arithmetic: coordinate d is the fraction of i a^(d + 1) / 2^32.
TEST(Lattice, CoordinatesAreThoseOfKorobovsLattice) {
    for (const std::uint32_t index : {0u, 1u, 2u, 3u, 5u, 1'000u, 123'456'789u, 0xffffffffu}) {
        std::uint64_t factor = 1; // a^d modulo 2^32
        for (std::uint32_t d = 0; d < 1'000; ++d) {
            factor = factor * korobov_factor % (1ull << 32);
            const uvec4 p = lattice4(index, d / 4);
            EXPECT_EQ(p[static_cast<int>(d % 4)], index * factor % (1ull << 32))
                << index << ", " << d;
        }
    }
}

/// Coordinate d of a point, from 0 to 1.
double coordinate(std::uint32_t index, int d) {
    return std::ldexp(lattice4(index, static_cast<std::uint32_t>(d / 4))[d % 4], -32);
}

/// The mean square error of `count` points over random shifts, over that of random points, in the
/// dimensions first to end: for functions with the kernel of Bernoulli's second polynomial.
double error_over_random(std::uint32_t count, int first, int end) {
    const auto kernel = [&](std::uint32_t index) {
        double product = 1;
        for (int d = first; d < end; ++d) {
            const double t = coordinate(index, d);
            product *= 1 + 3 * (t * t - t + 1.0 / 6);
        }
        return product;
    };
    const double n = count;
    double sum = n * kernel(0);
    for (std::uint32_t i = 1; i < count; ++i) {
        sum += 2 * (n - i) * kernel(i);
    }
    return (sum / (n * n) - 1) / ((kernel(0) - 1) / n);
}

TEST(Lattice, AnyNumberOfPointsHasLessErrorThanRandomOnes) {
    for (const std::uint32_t count : {16u, 25u, 64u, 100u, 256u, 1'024u, 3'000u}) {
        for (const int first : {0, 4, 8, 12, 16}) { // of each vertex
            EXPECT_LT(error_over_random(count, first, first + 4), count < 64 ? 0.9 : 0.6)
                << count << ", " << first;
        }
        for (const int vertices : {2, 3, 4}) { // of the first vertices together
            EXPECT_LT(error_over_random(count, 0, 4 * vertices), 1) << count << ", " << vertices;
        }
    }
    EXPECT_LT(error_over_random(3'000, 0, 4), 0.2);
}

// Vertices, choices and aims of a path have dimensions of their own. Seeds and pixels only move
// points.
TEST(Lattice, PathsShareOnePointOfManyDimensions) {
    constexpr std::uint32_t any_point = 12'345'677;
    const auto photon = [](std::uint32_t i, std::uint32_t dimension) {
        return photon_random4(0, i, dimension, numbers_lattice);
    };
    const auto eye = [](std::uint32_t seed, std::uint32_t pixel, std::uint32_t i,
                        std::uint32_t dimension) {
        return eye_random4(seed, pixel, i, dimension, true);
    };
    const auto differ = [](vec4 a, vec4 b) { // on the circle
        const vec4 difference = a - b;
        return glm::any(
            glm::greaterThan(glm::abs(difference - glm::round(difference)), vec4(1e-6f)));
    };
    std::vector<vec4> moves_of_photons, moves_of_eyes;
    moves_of_photons.reserve(120);
    moves_of_eyes.reserve(60);
    for (std::uint32_t d = 0; d < 60; ++d) {
        for (const std::uint32_t dimension : {d, dimension_of_choices + d}) {
            moves_of_photons.push_back(photon(any_point, dimension) - photon(0, dimension));
        }
        moves_of_eyes.push_back(eye(0, 5, any_point, d) - eye(0, 5, 0, d));
        EXPECT_FALSE(differ(moves_of_eyes.back(), eye(9, 6, any_point, d) - eye(9, 6, 0, d)));
        EXPECT_TRUE(differ(eye(0, 5, 0, d), eye(0, 6, 0, d)));
    }
    for (const std::vector<vec4>& moves : {moves_of_photons, moves_of_eyes}) {
        for (std::size_t a = 0; a < moves.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                EXPECT_TRUE(differ(moves[a], moves[b])) << a << ", " << b;
            }
        }
    }
}

} // namespace
} // namespace argand
