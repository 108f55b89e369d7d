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

/// Remembers the input with the worst error.
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
        // Uniform numbers as the renderer has them, and tiny ones.
        const float u = i % 4 == 0 ? any_magnitude(bits, -60, 0) : static_cast<float>(bits() >> 8) * 0x1p-24f;
        float s = 0;
        float c = 0;
        sincos_2pi(u, s, c);
        // The nearest quarter turn is taken off exactly, so that the truth is exact near the zeros.
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
    EXPECT_LE(sine.error, 2.5) << sine;
    EXPECT_LE(cosine.error, 2.5) << cosine;
}

TEST(Elementary, QuarterTurnsAreExact) {
    const float truths[5][3] = {{0, 0, 1}, {0.25f, 1, 0}, {0.5f, 0, -1}, {0.75f, -1, 0}, {-0.25f, -1, 0}};
    for (const auto& truth : truths) {
        float s = 2;
        float c = 2;
        sincos_2pi(truth[0], s, c);
        EXPECT_EQ(s, truth[1]);
        EXPECT_EQ(c, truth[2]);
    }
}

TEST(Elementary, SinesOfRadiansHaveAFewUlps) {
    std::mt19937 bits(2);
    Worst worst;
    Worst absolute;
    for (int i = 0; i < tries; ++i) {
        const bool large = i % 2 == 0;
        float x = large ? any_magnitude(bits, 3, 13) : any_magnitude(bits, -40, 3);
        x = i % 4 < 2 ? x : -x;
        if (i % 16 == 0) { // beside multiples of pi/2, where digits cancel
            x = static_cast<float>(double(bits() % 5000) * 0.5 * pi);
        }
        float s = 0;
        float c = 0;
        sincos_real(x, s, c);
        absolute.take(std::abs(s - std::sin(double(x))), x);
        absolute.take(std::abs(c - std::cos(double(x))), x);
        if (std::abs(x) < 8) {
            worst.take(ulps(s, std::sin(double(x))), x);
            worst.take(ulps(c, std::cos(double(x))), x);
        }
    }
    EXPECT_LE(worst.error, 2.5) << worst;
    EXPECT_LE(absolute.error, 1e-7) << absolute;
}

TEST(Elementary, ArcCosineHasAFewUlps) {
    std::mt19937 bits(3);
    Worst worst;
    for (int i = 0; i < tries; ++i) {
        float x = 0;
        if (i % 3 == 0) {
            x = 1 - any_magnitude(bits, -24, 0); // near 1, where the angle is small
        } else {
            x = i % 3 == 1 ? static_cast<float>(bits() >> 8) * 0x1p-24f : any_magnitude(bits, -100, 0);
        }
        x = i % 2 == 0 ? x : -x;
        worst.take(ulps(acos_real(x), std::acos(double(x))), x);
    }
    EXPECT_LE(worst.error, 1.5) << worst;
    EXPECT_EQ(acos_real(1.0f), 0.0f);
    EXPECT_EQ(acos_real(1.0000001f), 0.0f);
    EXPECT_EQ(acos_real(-1.5f), static_cast<float>(pi));
    EXPECT_EQ(acos_real(0.0f), static_cast<float>(pi / 2));
}

TEST(Elementary, ArcTangentHasAFewUlps) {
    std::mt19937 bits(4);
    Worst worst;
    for (int i = 0; i < tries; ++i) {
        const float y =
            i % 2 == 0 ? any_finite(bits) : any_magnitude(bits, -2, 2) * (i % 4 == 1 ? 1.0f : -1.0f);
        const float x =
            i % 2 == 0 ? any_finite(bits) : any_magnitude(bits, -2, 2) * (i % 8 < 4 ? 1.0f : -1.0f);
        // Where the quotient is subnormal its own rounding counts; the bound holds in units of the result.
        worst.take(ulps(atan2_real(y, x), std::atan2(double(y), double(x))), x, y);
    }
    EXPECT_LE(worst.error, 2.5) << worst;
}

TEST(Elementary, ArcTangentOfTheAxesHasTheRightSide) {
    for (const float x : {0.0f, -0.0f, 1.0f, -1.0f, 3e38f, -3e38f}) {
        for (const float y : {0.0f, -0.0f, 1.0f, -1.0f, 3e38f, -3e38f}) {
            EXPECT_LE(ulps(atan2_real(y, x), std::atan2(double(y), double(x))), 1) << y << " " << x;
            EXPECT_EQ(std::signbit(atan2_real(y, x)), std::signbit(y)) << y << " " << x;
        }
    }
}

TEST(Elementary, ExponentialHasAFewUlps) {
    std::mt19937 bits(5);
    Worst worst;
    for (int i = 0; i < tries; ++i) {
        const float x = i % 2 == 0 ? std::uniform_real_distribution<float>(-105, 90)(bits) : any_finite(bits);
        worst.take(ulps(exp_real(x), std::exp(double(x))), x);
    }
    EXPECT_LE(worst.error, 1) << worst;
    EXPECT_EQ(exp_real(0.0f), 1.0f);
    EXPECT_EQ(exp_real(std::numeric_limits<float>::infinity()), std::numeric_limits<float>::infinity());
    EXPECT_EQ(exp_real(-std::numeric_limits<float>::infinity()), 0.0f);
    EXPECT_TRUE(std::isnan(exp_real(std::numeric_limits<float>::quiet_NaN())));
}

TEST(Elementary, LogarithmHasAFewUlps) {
    std::mt19937 bits(6);
    Worst worst;
    for (int i = 0; i < tries; ++i) {
        float x = std::abs(any_finite(bits));
        if (i % 3 == 0) {
            x = 1 + any_magnitude(bits, -24, 0) * (i % 2 == 0 ? 1.0f : -0.9f); // near 1, where it is small
        }
        worst.take(ulps(log_real(x), std::log(double(x))), x);
    }
    EXPECT_LE(worst.error, 1) << worst;
    EXPECT_EQ(log_real(1.0f), 0.0f);
    EXPECT_EQ(log_real(0.0f), -std::numeric_limits<float>::infinity());
    EXPECT_EQ(log_real(-0.0f), -std::numeric_limits<float>::infinity());
    EXPECT_EQ(log_real(std::numeric_limits<float>::infinity()), std::numeric_limits<float>::infinity());
    EXPECT_TRUE(std::isnan(log_real(-1.0f)));
    EXPECT_TRUE(std::isnan(log_real(std::numeric_limits<float>::quiet_NaN())));
}

TEST(Elementary, PowerHasAFewUlps) {
    std::mt19937 bits(7);
    Worst worst;
    for (int i = 0; i < tries; ++i) {
        float x = std::abs(any_finite(bits));
        float y = any_magnitude(bits, -10, 10) * (i % 2 == 0 ? 1.0f : -1.0f);
        if (i % 3 == 0) { // results over all of the range
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

TEST(Elementary, FiniteIsToldByTheBits) {
    EXPECT_TRUE(is_finite(0.0f));
    EXPECT_TRUE(is_finite(-std::numeric_limits<float>::max()));
    EXPECT_TRUE(is_finite(std::numeric_limits<float>::denorm_min()));
    EXPECT_FALSE(is_finite(std::numeric_limits<float>::infinity()));
    EXPECT_FALSE(is_finite(-std::numeric_limits<float>::infinity()));
    EXPECT_FALSE(is_finite(std::numeric_limits<float>::quiet_NaN()));
}

} // namespace
} // namespace argand
