#include "numbers.hpp"
#include "shared/elementary.h"

#include <gtest/gtest.h>

namespace argand {
namespace {

using testing::any_finite;
using testing::any_magnitude;
using testing::ulps;

constexpr double pi = 3.14159265358979323846;
constexpr int tries = 1'000'000;

/// Keeps the input with the largest error.
struct Worst {
    double error = 0;
    float x = 0, y = 0;
    void take(double e, float at_x, float at_y = 0) {
        if (!(e <= error)) {
            *this = {e, at_x, at_y};
        }
    }
};
std::ostream& operator<<(std::ostream& out, const Worst& w) {
    return out << w.error << " at " << std::hexfloat << w.x << ", " << w.y << std::defaultfloat;
}

TEST(Elementary, SinesOfTurnsHaveAFewUlps) {
    std::mt19937 bits(1);
    Worst sine;
    Worst cosine;
    for (int i = 0; i < tries; ++i) {
        // Uniform numbers as the renderer generates them, and tiny ones.
        const float u =
            i % 4 == 0 ? any_magnitude(bits, -60, 0) : static_cast<float>(bits() >> 8) * 0x1p-24f;
        float s = 0;
        float c = 0;
        sincos_2pi(u, s, c);
        // Subtract the nearest quarter turn exactly, so that the reference is accurate near the
        // zeros.
        const double quarter = std::floor(4 * double(u) + 0.5);
        const double x = 2 * pi * (double(u) - 0.25 * quarter);
        const double truths[4][2] = {{std::sin(x), std::cos(x)},
                                     {std::cos(x), -std::sin(x)},
                                     {-std::sin(x), -std::cos(x)},
                                     {-std::cos(x), std::sin(x)}};
        const auto& truth = truths[static_cast<int>(quarter) & 3];
        sine.take(ulps(s, truth[0]), u);
        cosine.take(ulps(c, truth[1]), u);
    }
    EXPECT_LE(sine.error, 2.5) << "sine " << sine;
    EXPECT_LE(cosine.error, 2.5) << "cosine " << cosine;
}

TEST(Elementary, AnglesInTurnsHaveAFewUlps) {
    std::mt19937 bits(8);
    Worst worst;
    for (int i = 0; i < tries; ++i) {
        const float x = any_magnitude(bits, -60, 60) * ((bits() & 1u) != 0 ? 1.0f : -1.0f);
        // Of the same magnitude, or any other.
        const float y =
            (i % 2 == 0 ? any_magnitude(bits, -60, 60) : x * any_magnitude(bits, -3, 3)) *
            ((bits() & 1u) != 0 ? 1.0f : -1.0f);
        worst.take(ulps(turn_of(y, x), std::atan2(double(y), double(x)) / (2 * pi)), y, x);
    }
    EXPECT_LE(worst.error, 4) << worst;
    EXPECT_EQ(turn_of(0, 1), 0);
    EXPECT_EQ(turn_of(0, 0), 0);
    EXPECT_EQ(turn_of(1, 0), 0.25f);
    EXPECT_EQ(turn_of(-1, 0), -0.25f);
    EXPECT_EQ(turn_of(0, -1), 0.5f);
    EXPECT_EQ(turn_of(1, 1), 0.125f);
}

TEST(Elementary, QuarterTurnsAreExact) {
    const float truths[5][3] = {
        {0, 0, 1}, {0.25f, 1, 0}, {0.5f, 0, -1}, {0.75f, -1, 0}, {-0.25f, -1, 0}};
    for (const auto& truth : truths) {
        float s = 2;
        float c = 2;
        sincos_2pi(truth[0], s, c);
        EXPECT_EQ(s, truth[1]);
        EXPECT_EQ(c, truth[2]);
    }
}

TEST(Elementary, PowerHasAFewUlps) {
    std::mt19937 bits(7);
    Worst worst;
    for (int i = 0; i < tries; ++i) {
        float x = std::abs(any_finite(bits));
        float y = any_magnitude(bits, -10, 10) * (i % 2 == 0 ? 1.0f : -1.0f);
        if (i % 3 == 0) { // results over the whole range
            x = i % 2 == 0 ? any_magnitude(bits, -1, 1) : any_magnitude(bits, -126, 127);
            y = static_cast<float>(std::uniform_real_distribution<double>(-103, 89)(bits) /
                                   std::log(double(x)));
        } else if (i % 3 == 1) {
            y = any_finite(bits);
        }
        if (std::isfinite(y)) {
            worst.take(ulps(pow_real(x, y), std::pow(double(x), double(y))), x, y);
        }
    }
    EXPECT_LE(worst.error, 1.5) << worst;
    EXPECT_EQ(pow_real(0.0f, 0.0f), 1.0f);
    EXPECT_EQ(pow_real(0.0f, 2.0f), 0.0f);
    EXPECT_EQ(pow_real(0.0f, -1.0f), std::numeric_limits<float>::infinity());
    EXPECT_EQ(pow_real(2.0f, 10.0f), 1024.0f);
}

TEST(Elementary, LogarithmAndExponentialKeepTheDigitsOfSmallNumbers) {
    std::mt19937 bits(9);
    Worst log;
    Worst exp;
    Worst complement;
    for (int i = 0; i < tries; ++i) {
        const float x =
            i % 2 == 0 ? any_magnitude(bits, -100, -1) : static_cast<float>(bits() >> 8) * 0x1p-24f;
        log.take(ulps(log_complement(x), std::log1p(-double(x))), x);
        const float y = i % 2 == 0 ? -any_magnitude(bits, -100, 0)
                                   : -static_cast<float>(bits() >> 8) * 0x1p-18f;
        complement.take(ulps(exp_complement(y), -std::expm1(double(y))), y);
        exp.take(ulps(exp_negative(y), std::exp(double(y))), y);
    }
    EXPECT_LE(log.error, 3) << "log " << log;
    EXPECT_LE(exp.error, 2) << "exp " << exp;
    EXPECT_LE(complement.error, 2) << "complement " << complement;
    EXPECT_EQ(log_complement(0.0f), 0.0f);
    EXPECT_EQ(exp_negative(0.0f), 1.0f);
    EXPECT_EQ(exp_complement(0.0f), 0.0f);
    EXPECT_EQ(exp_negative(-1e30f), 0.0f);
    EXPECT_EQ(exp_negative(-std::numeric_limits<float>::infinity()), 0.0f);
    EXPECT_EQ(exp_complement(-1e30f), 1.0f);
}

TEST(Elementary, IsFiniteTestsTheBits) {
    EXPECT_TRUE(is_finite(0.0f));
    EXPECT_TRUE(is_finite(-std::numeric_limits<float>::max()));
    EXPECT_TRUE(is_finite(std::numeric_limits<float>::denorm_min()));
    EXPECT_FALSE(is_finite(std::numeric_limits<float>::infinity()));
    EXPECT_FALSE(is_finite(-std::numeric_limits<float>::infinity()));
    EXPECT_FALSE(is_finite(std::numeric_limits<float>::quiet_NaN()));
}

} // namespace
} // namespace argand
