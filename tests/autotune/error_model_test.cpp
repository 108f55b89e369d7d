#include "autotune/error_model.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace argand {
namespace {

TEST(ErrorModel, FindsTheFewestPassesForAnError) {
    const ErrorModel model{.fixed = 0.05, .density = 0.01, .bias = {0.002, 0}};
    for (const double error : {0.05, 0.01, 0.002, 0.001}) {
        const double passes = passes_for(model, error);
        EXPECT_LE(error_after(model, passes), error);
        EXPECT_GT(error_after(model, 0.99 * passes), error);
    }
    EXPECT_EQ(passes_for(model, 1), 1);
    EXPECT_TRUE(std::isinf(passes_for(model, 1e-9)));
    EXPECT_EQ(passes_for({.fixed = 0, .density = 0, .bias = {0, 0}}, 1e-9), 1);
}

TEST(ErrorModel, SplitsNoiseByItsGrowthAsBandwidthsShrink) {
    // Kernels at the bandwidth for 8 passes have half the area.
    const ErrorModel model = fit_noise(0.03 + 0.01, 0.03 + 0.02, 8);
    EXPECT_NEAR(model.fixed, 0.03, 1e-12);
    EXPECT_NEAR(model.density, 0.01, 1e-12);
    EXPECT_NEAR(noise_after(model, 8), (0.03 + 0.02) / 8, 1e-12);
    EXPECT_EQ(fit_noise(0.04, 0.02, 8).density, 0);
    EXPECT_EQ(fit_noise(0.04, 10, 8).fixed, 0);
}

TEST(ErrorModel, FirstPassesHaveTheInitialBandwidth) {
    const ErrorModel model{
        .fixed = 0.03, .density = 0.01, .bias = {0.002, 0.001}, .initial_passes = 2};
    EXPECT_NEAR(noise_after(model, 2), (0.03 + 0.01) / 2, 1e-12);
    EXPECT_EQ(bias_after(model, 2).value, 0.002);
    // Two of eight passes have the initial bandwidth. That for eight passes leaves 1 / sqrt(2) of
    // the bias.
    EXPECT_NEAR(noise_after(model, 8), (2 * 0.04 + 6 * 0.05) / 64, 1e-12);
    const double share = 0.25 + 0.75 / std::sqrt(2);
    EXPECT_NEAR(bias_after(model, 8).value, 0.002 * share * share, 1e-12);
    EXPECT_NEAR(bias_after(model, 8).error, 0.001 * share * share, 1e-12);
}

// Pass i of a progressive render has the width i^(-a), and the image is the mean of the passes.
TEST(ErrorModel, OfWidthsThatFallFromPassToPassIsThatOfTheMean) {
    for (const double exponent : {1.0 / 6, 0.2, 0.25, 0.4}) {
        const ErrorModel model{
            .fixed = 0.03, .density = 0.01, .bias = {0.002, 0}, .law = progressive_law(exponent)};
        double variances = 0, biases = 0;
        for (int pass = 1; pass <= 1000; ++pass) {
            const double width = std::pow(pass, -exponent);
            variances += 0.03 + 0.01 / (width * width);
            biases += std::sqrt(0.002) * width; // squared bias goes with the area
            EXPECT_NEAR(noise_after(model, pass), variances / (double(pass) * pass),
                        1e-3 * variances / (double(pass) * pass));
            const double bias = biases / pass;
            EXPECT_NEAR(bias_after(model, pass).value, bias * bias, 3e-3 * bias * bias);
        }
        EXPECT_DOUBLE_EQ(bias_at(model.law, 8), std::pow(8, -2 * exponent));
    }
}

} // namespace
} // namespace argand
