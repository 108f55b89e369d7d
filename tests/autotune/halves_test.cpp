#include "autotune/estimate.hpp"
#include "autotune/halves.hpp"
#include "support/noisy_image.hpp"

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
        if (halves.are_two()) {
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
    EXPECT_FALSE(halves.are_two());
    halves.add(noisy(4, 4, 0, 1, 2));
    EXPECT_EQ(halves.stream(), 0u);
    EXPECT_TRUE(halves.are_two());
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
    EXPECT_NEAR(smooth.value, expected,
                2 * smooth.error); // it takes the difference for one that smoothing lessens
    const auto [none, smooth_none] = squared_difference(pair(0.1, 11), pair(0.1, 13), reference);
    EXPECT_NEAR(none.value, 0, 4 * none.error);
    EXPECT_NEAR(smooth_none.value, 0, 4 * smooth_none.error);
    EXPECT_LT(smooth_none.error, 0.5 * none.error);
}

TEST(Estimate, PosteriorIsBetweenWhatIsUsualAndWhatIsSeen) {
    EXPECT_NEAR(posterior(3, 2, {}).value, 3, 1e-9);
    EXPECT_NEAR(posterior(3, 2, std::array{Estimate{}}).value, 3, 1e-9);
    EXPECT_NEAR(posterior(3, 2, std::array{Estimate{7, 0.1}}).value, 7, 0.05);
    EXPECT_NEAR(posterior(3, 2, std::array{Estimate{7, 0.1}}).error, 0.1, 0.02);
    EXPECT_NEAR(posterior(3, 2, std::array{Estimate{4, 0.1}, Estimate{5, 0.1}}).value, 4.5, 0.02);
    const Estimate seen = posterior(3, 2, std::array{Estimate{0, 1}});
    EXPECT_LT(seen.value, 2);
    EXPECT_GT(seen.value, 0.5);
    EXPECT_LT(seen.error, posterior(3, 2, {}).error);
    // Far from what is usual.
    EXPECT_NEAR(posterior(3, 2, std::array{Estimate{3000, 100}}).value, 3000, 100);
    // What cannot be.
    EXPECT_GT(posterior(3, 2, std::array{Estimate{-100, 1e-9}}).value, 0);
    EXPECT_TRUE(std::isfinite(posterior(3, 2, std::array{Estimate{1e30, 0}}).value));
    EXPECT_EQ(posterior(0, 2, std::array{Estimate{1, 1}}).value, 0);
}

TEST(Estimate, GuessIsThePictureButForDotsOfOneOfTheTwo) {
    std::array pictures{noisy(side, side, 0, 0.1, 1), noisy(side, side, 0, 0.1, 2)};
    pictures[0].pixels[side * 20 + 30] = glm::vec3(1000);
    const Image guess = guess_from(pictures);
    double mean = 0;
    for (const glm::vec3& pixel : guess.pixels) {
        mean += pixel.g / static_cast<double>(guess.pixels.size());
    }
    EXPECT_NEAR(mean, true_radiance, 0.03);
    EXPECT_LT(guess.pixels[side * 20 + 30].g, 1.5 * true_radiance);
    // As dark as the other one says, and finite where a mean without a pass is a rounding below 0.
    for (std::size_t half = 0; half < 2; ++half) {
        pictures[1 - half].pixels.assign(pictures[half].pixels.size(), glm::vec3(-1e-9f));
        EXPECT_EQ(guess_from(pictures).pixels[side * 20 + 30], glm::vec3(0));
    }
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
