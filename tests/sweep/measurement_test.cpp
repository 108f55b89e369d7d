#include "image/metrics.hpp"
#include "sweep/fake.hpp"

namespace argand::testing {
namespace {

constexpr int side = 64;

Trials trials_of(double bias, double deviation, std::uint32_t seeds) {
    Trials trials{.trials = {}, .peak_bytes = 7};
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        trials.trials.push_back(
            {.picture = noisy(side, side, bias, deviation, seed), .wall_seconds = 1.0 + seed});
    }
    return trials;
}

Reference reference(double deviation) {
    return {.a = noisy(side, side, 0, deviation, 1000), .b = noisy(side, side, 0, deviation, 1001)};
}

// The denominator of relMSE: the square of the radiance plus a hundredth of it.
constexpr double divisor = 1.01 * true_radiance * true_radiance;

TEST(Measurement, SeparatesBiasFromVariance) {
    constexpr double bias = 0.2, deviation = 0.3;
    const Measurement m =
        measure({"default", "", {}}, trials_of(bias, deviation, 4), reference(0.1));
    // 4 × 64 × 64 × 3 samples: the standard error of the variance is 0.7 %, that of the squared
    // bias 1.5 %.
    EXPECT_NEAR(*m.bias, bias * bias / divisor, 0.06 * bias * bias / divisor);
    EXPECT_NEAR(*m.variance, deviation * deviation / divisor,
                0.03 * deviation * deviation / divisor);
    EXPECT_NEAR(*m.bias + *m.variance, m.rel_mse.mean, 1e-12);
}

TEST(Measurement, WithoutBiasFindsNone) {
    const Measurement m = measure({"default", "", {}}, trials_of(0, 0.3, 4), reference(0.1));
    EXPECT_NEAR(*m.bias, 0, 0.03 * *m.variance);
}

TEST(Measurement, IgnoresTheNoiseOfThePair) {
    const Trials trials = trials_of(0.1, 0, 2);
    const Reference pair = reference(0.05);
    const double with_pair = measure({"default", "", {}}, trials, pair).rel_mse.mean;
    const double with_one =
        measure({"default", "", {}}, trials, {.a = pair.a, .b = pair.a}).rel_mse.mean;
    EXPECT_NEAR(with_pair, 0.01 / divisor, 0.1 * 0.01 / divisor);
    EXPECT_NEAR(with_one, (0.01 + 0.05 * 0.05) / divisor, 0.1 * 0.0125 / divisor);
}

TEST(Measurement, TakesTheMedianOfTimes) {
    Trials trials = trials_of(0, 0.1, 3);
    trials.trials[2].wall_seconds = 100;
    const Measurement m = measure({"default", "", {}}, trials, reference(0));
    EXPECT_EQ(m.wall_seconds, 2);
    EXPECT_FALSE(m.device_seconds);
    EXPECT_EQ(m.peak_bytes, 7u);
    EXPECT_EQ(m.seeds, 3u);
}

TEST(Measurement, HasNoVarianceFromOneSeed) {
    const Measurement m = measure({"default", "", {}}, trials_of(0.2, 0.3, 1), reference(0));
    EXPECT_FALSE(m.bias);
    EXPECT_FALSE(m.variance);
    EXPECT_EQ(m.rel_mse.deviation, 0);
    EXPECT_GT(m.rel_mse.mean, 0);
}

TEST(Measurement, SurvivesJson) {
    Measurement m = measure({"photons", "10", {}}, trials_of(0.2, 0.3, 2), reference(0));
    m.picture = "pictures/a.exr";
    EXPECT_EQ(to_json(measurement_from(to_json(m))), to_json(m));
    const Measurement one = measure({"default", "", {}}, trials_of(0.2, 0.3, 1), reference(0));
    EXPECT_EQ(to_json(measurement_from(to_json(one))), to_json(one));
}

TEST(Measurement, ErrorAgainstABlackReferenceIsInfinite) {
    const Image black{1, 1, {glm::vec3(0)}}, white{1, 1, {glm::vec3(1)}};
    const Trials trials{.trials = {{.picture = white, .wall_seconds = 1}}, .peak_bytes = 0};
    const Measurement m = measure({"default", "", {}}, trials, {.a = black, .b = black});
    EXPECT_TRUE(std::isinf(m.rel_mse.mean));
    EXPECT_TRUE(std::isinf(
        measurement_from(nlohmann::ordered_json::parse(to_json(m).dump())).rel_mse.mean));
}

} // namespace
} // namespace argand::testing
