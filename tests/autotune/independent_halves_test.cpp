#include "autotune/estimate.hpp"
#include "autotune/independent_halves.hpp"
#include "support/noisy_image.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <span>

namespace argand {
namespace {

using testing::noisy;
using testing::true_radiance;

constexpr int side = 64;

/// The running mean of passes that each have a bias and independent noise.
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

TEST(IndependentHalves, MeasuresTheNoiseOfTheMeanAfterAnyNumberOfPasses) {
    constexpr double deviation = 0.2;
    const Image reference = noisy(side, side, 0, 0, 0);
    IndependentHalves halves;
    Passes passes;
    std::uint64_t turns = 0;
    for (std::uint64_t done = 1; done <= 500; ++done) {
        const Image mean = passes.next(0, deviation, static_cast<std::uint32_t>(done));
        if (done < halves.next()) {
            continue;
        }
        halves.add(mean);
        ++turns;
        if (halves.both_have_passes()) {
            const double scale = 1.01 * true_radiance * true_radiance;
            const double expected = deviation * deviation / static_cast<double>(done) / scale;
            EXPECT_NEAR(halves.noise(reference) / expected, 1, 0.1) << done;
        }
    }
    EXPECT_LT(turns, 100u);
}

TEST(IndependentHalves, StreamsTakeTurnsAndTheFirstIsZero) {
    IndependentHalves halves;
    EXPECT_EQ(halves.stream(), 0u);
    halves.add(noisy(4, 4, 0, 1, 1));
    EXPECT_EQ(halves.stream(), 1u);
    EXPECT_FALSE(halves.both_have_passes());
    halves.add(noisy(4, 4, 0, 1, 2));
    EXPECT_EQ(halves.stream(), 0u);
    EXPECT_TRUE(halves.both_have_passes());
}

TEST(Estimate, SquaredDifferenceIsFreeOfNoise) {
    const Image reference = noisy(side, side, 0, 0, 0);
    const auto pair = [](double bias, std::uint32_t seed) {
        return std::array{noisy(side, side, bias, 0.5, seed),
                          noisy(side, side, bias, 0.5, seed + 1)};
    };
    const double expected = 0.2 * 0.2 / (1.01 * true_radiance * true_radiance);
    const auto [raw, smooth] = squared_difference(pair(0.3, 1), pair(0.1, 3), reference);
    EXPECT_LT(raw.error, 0.3 * expected);
    EXPECT_NEAR(raw.value, expected, 4 * raw.error);
    // The second estimate is scaled up, as if smoothing had removed a part of the difference.
    EXPECT_NEAR(smooth.value, expected, 2 * smooth.error);
    const auto [none, smooth_none] = squared_difference(pair(0.1, 11), pair(0.1, 13), reference);
    EXPECT_NEAR(none.value, 0, 4 * none.error);
    EXPECT_NEAR(smooth_none.value, 0, 4 * smooth_none.error);
    EXPECT_LT(smooth_none.error, 0.5 * none.error);
}

Estimate posterior(double usual, double factor, std::span<const Estimate> estimates) {
    return Posterior({.usual = usual, .factor = factor}, estimates).estimate();
}

TEST(Estimate, PosteriorLiesBetweenPriorAndEstimates) {
    EXPECT_NEAR(posterior(3, 2, {}).value, 3, 1e-9);
    EXPECT_NEAR(posterior(3, 2, std::array{Estimate{}}).value, 3, 1e-9);
    EXPECT_NEAR(posterior(3, 2, std::array{Estimate{7, 0.1}}).value, 7, 0.05);
    EXPECT_NEAR(posterior(3, 2, std::array{Estimate{7, 0.1}}).error, 0.1, 0.02);
    EXPECT_NEAR(posterior(3, 2, std::array{Estimate{4, 0.1}, Estimate{5, 0.1}}).value, 4.5, 0.02);
    const Estimate both = posterior(3, 2, std::array{Estimate{0, 1}});
    EXPECT_LT(both.value, 2);
    EXPECT_GT(both.value, 0.5);
    EXPECT_LT(both.error, posterior(3, 2, {}).error);
    // Far from the usual value.
    EXPECT_NEAR(posterior(3, 2, std::array{Estimate{3000, 100}}).value, 3000, 100);
    // Impossible values: negative, or infinitely exact.
    EXPECT_GT(posterior(3, 2, std::array{Estimate{-100, 1e-9}}).value, 0);
    EXPECT_TRUE(std::isfinite(posterior(3, 2, std::array{Estimate{1e30, 0}}).value));
    EXPECT_EQ(posterior(0, 2, std::array{Estimate{1, 1}}).value, 0);
}

TEST(Estimate, GuessIsTheImageWithoutFirefliesOfOneOfTheTwo) {
    std::array images{noisy(side, side, 0, 0.1, 1), noisy(side, side, 0, 0.1, 2)};
    images[0].pixels[side * 20 + 30] = glm::vec3(1000);
    const Image guess = guess_from(images);
    double mean = 0;
    for (const glm::vec3& pixel : guess.pixels) {
        mean += pixel.g / static_cast<double>(guess.pixels.size());
    }
    EXPECT_NEAR(mean, true_radiance, 0.03);
    EXPECT_LT(guess.pixels[side * 20 + 30].g, 1.5 * true_radiance);
    // Takes the darker image, and stays finite where rounding makes it slightly negative.
    for (std::size_t half = 0; half < 2; ++half) {
        images[1 - half].pixels.assign(images[half].pixels.size(), glm::vec3(-1e-9f));
        EXPECT_EQ(guess_from(images).pixels[side * 20 + 30], glm::vec3(0));
    }
}

TEST(Estimate, GuessFromFewPassesHeedsEdgesAndPenumbrae) {
    // A lamp of 20 beside a wall of 1, and a corner that one of the two images has not seen lit.
    Image lit{4, 4, std::vector<glm::vec3>(16, glm::vec3(1))};
    for (std::size_t y = 0; y < 4; ++y) {
        lit.pixels[4 * y] = glm::vec3(20);
    }
    Image unlit = lit;
    unlit.pixels[15] = glm::vec3(0);
    const Image guess = guess_from_few({lit, unlit});
    EXPECT_GT(guess.pixels[4].g, 5); // the lamp
    EXPECT_GE(guess.pixels[5].g, 1); // beside it, where the mean of 3 x 3 pixels is above 7
    EXPECT_LE(guess.pixels[5].g, 2);
    EXPECT_GT(guess.pixels[15].g, 0.2);
    EXPECT_LE(guess.pixels[15].g, 1);
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
