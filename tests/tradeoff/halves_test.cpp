#include "fake.hpp"
#include "tradeoff/estimate.hpp"
#include "tradeoff/halves.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace argand {
namespace {

using testing::noisy;
using testing::true_radiance;

constexpr int side = 64;

/// The mean of the passes so far, each with a bias and noise of its own.
class Passes {
public:
    Image next(double bias, double deviation, std::uint32_t seed) {
        const Image pass = noisy(side, side, bias, deviation, seed);
        mean_.resize(pass.pixels.size(), glm::dvec3(0));
        ++count_;
        Image so_far = pass;
        for (std::size_t i = 0; i < mean_.size(); ++i) {
            mean_[i] += (glm::dvec3(pass.pixels[i]) - mean_[i]) / count_;
            so_far.pixels[i] = mean_[i];
        }
        return so_far;
    }

private:
    std::vector<glm::dvec3> mean_;
    double count_ = 0;
};

TEST(Halves, NoiseOfTheMeanIsToldAtAnyNumberOfPasses) {
    constexpr double deviation = 0.2;
    const Image reference = noisy(side, side, 0, 0, 0);
    Halves halves;
    Passes passes;
    std::uint64_t looked = 0;
    for (std::uint64_t done = 1; done <= 500; ++done) {
        const Image mean = passes.next(0, deviation, static_cast<std::uint32_t>(done));
        if (done < halves.next()) {
            continue;
        }
        halves.add(mean);
        ++looked;
        if (halves.are_equal()) {
            const double scale = 1.01 * true_radiance * true_radiance;
            const double expected = deviation * deviation / static_cast<double>(done) / scale;
            EXPECT_NEAR(halves.noise(reference) / expected, 1, 0.1) << done;
        }
    }
    EXPECT_LT(looked, 100u);
}

TEST(Halves, StreamsTakeTurnsAndTheFirstIsZero) {
    Halves halves;
    EXPECT_EQ(halves.stream(), 0u);
    halves.add(noisy(4, 4, 0, 1, 1));
    EXPECT_EQ(halves.stream(), 1u);
    EXPECT_FALSE(halves.are_equal());
    halves.add(noisy(4, 4, 0, 1, 2));
    EXPECT_EQ(halves.stream(), 0u);
    EXPECT_TRUE(halves.are_equal());
}

TEST(Estimate, SquaredDifferenceIsFreeOfNoise) {
    const Image reference = noisy(side, side, 0, 0, 0);
    const auto pair = [](double bias, std::uint32_t seed) {
        return std::array{noisy(side, side, bias, 0.5, seed), noisy(side, side, bias, 0.5, seed + 1)};
    };
    const Estimate difference = squared_difference(pair(0.3, 1), pair(0.1, 3), reference);
    const double expected = 0.2 * 0.2 / (1.01 * true_radiance * true_radiance);
    EXPECT_LT(difference.error, 0.2 * expected);
    EXPECT_NEAR(difference.value, expected, 4 * difference.error);
    const Estimate none = squared_difference(pair(0.1, 11), pair(0.1, 13), reference);
    EXPECT_NEAR(none.value, 0, 4 * none.error);
}

TEST(Estimate, PooledByErrors) {
    const std::array two{Estimate{1, 0.1}, Estimate{3, 0.1}};
    EXPECT_NEAR(pooled(two).value, 2, 1e-12);
    EXPECT_NEAR(pooled(two).error, 0.1 / std::sqrt(2), 1e-12);
    const std::array with_unknown{Estimate{1, 0.1}, Estimate{}};
    EXPECT_NEAR(pooled(with_unknown).value, 1, 1e-12);
    EXPECT_TRUE(std::isinf(pooled(std::array{Estimate{}}).error));
}

TEST(Estimate, SmoothingKeepsTheMeanInside) {
    Image dot{5, 5, std::vector<glm::vec3>(25, glm::vec3(0))};
    dot.pixels[12] = glm::vec3(9);
    EXPECT_EQ(smoothed(dot).pixels[6], glm::vec3(1));
    EXPECT_EQ(smoothed(dot).pixels[0], glm::vec3(0));
    const Image one{1, 1, {glm::vec3(2)}};
    EXPECT_EQ(smoothed(one).pixels[0], glm::vec3(2));
}

} // namespace
} // namespace argand
