// The pixel filter against the window's integral in double precision.
#include "shared/pixel_filter.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace argand {
namespace {

/// The window of Harris 1978, table 1, at a place of its length 1.
double window(double t) {
    const double turn = 2 * std::numbers::pi * t;
    return 0.35875 - 0.48829 * std::cos(turn) + 0.14128 * std::cos(2 * turn) -
           0.01168 * std::cos(3 * turn);
}

/// Its integral up to t, as a share, by Simpson's rule.
double share_before(double t) {
    constexpr int steps = 2000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double a = t * i / steps, b = t * (i + 1) / steps;
        sum += (window(a) + 4 * window(0.5 * (a + b)) + window(b)) * (b - a) / 6;
    }
    return sum / 0.35875;
}

TEST(PixelFilter, ShareIsTheWindowsIntegral) {
    for (int i = 0; i <= 1000; ++i) {
        const float t = 0.5f * static_cast<float>(i) / 1000;
        EXPECT_NEAR(blackman_harris_share(t), share_before(t), 2e-7) << t;
    }
}

TEST(PixelFilter, OffsetsFollowTheWindow) {
    for (int i = 0; i < 4096; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / 4096;
        const double place = 0.5 + 0.5 * double(blackman_harris_offset(u)) / 1.5;
        EXPECT_NEAR(place < 0.5 ? share_before(place) : 1 - share_before(1 - place), u, 4e-7) << u;
    }
}

TEST(PixelFilter, OffsetsStayWithinTheirReachAndAreSymmetric) {
    float last = -2;
    for (const float u : {0.0f, 0x1p-24f, 0x1p-20f, 0x1p-10f, 0.25f, 0.5f - 0x1p-24f, 0.5f,
                          0.5f + 0x1p-23f, 0.75f, 1 - 0x1p-10f, 1 - 0x1p-20f, 1 - 0x1p-24f}) {
        const float offset = blackman_harris_offset(u);
        EXPECT_LE(std::abs(offset), 1.5f) << u;
        EXPECT_GE(offset, last) << u;
        last = offset;
        if (u > 0 && u != 0.5f) {
            EXPECT_EQ(blackman_harris_offset(1 - u), -offset) << u;
        }
    }
}

} // namespace
} // namespace argand
