#include "interactive/frame_time.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace argand {
namespace {

constexpr PreviewLimits limits{.pixels = 512 * 512, .most_photons = 200'000};

/// A device whose costs are given. Estimates gather more photons where there are more of them.
struct Simulated {
    double photon = 1e-7, pixel = 2e-7, rest = 0.005; ///< seconds
    double noise = 0;                                 ///< relative
    std::mt19937 random{1};

    PreviewTime time(const PreviewSize& size) {
        std::normal_distribution<double> normal;
        const auto noisy = [&](double seconds) {
            return std::max(seconds * (1 + noise * normal(random)), 0.0);
        };
        const auto photons = static_cast<double>(size.photons);
        const double pixels = size.scale * size.scale * static_cast<double>(limits.pixels);
        const double gathered = 1 + std::pow(photons / 50'000, 2.0 / 3);
        return {noisy(photon * photons), noisy(pixel * gathered * pixels), noisy(rest)};
    }
};

double sum(const PreviewTime& time) { return time.photons + time.pixels + time.rest; }

/// Seconds of so many previews, one after the other.
std::vector<double> run(FrameTime& control, Simulated& device, int frames) {
    std::vector<double> seconds;
    for (int i = 0; i < frames; ++i) {
        const PreviewSize size = control.next();
        EXPECT_GE(size.scale, limits.least_scale);
        EXPECT_LE(size.scale, 1);
        EXPECT_GE(size.photons, limits.least_photons);
        EXPECT_LE(size.photons, limits.most_photons);
        const PreviewTime time = device.time(size);
        control.add(time);
        seconds.push_back(sum(time));
    }
    return seconds;
}

void expect_within(const std::vector<double>& seconds, std::size_t from, double target) {
    for (std::size_t i = from; i < seconds.size(); ++i) {
        EXPECT_NEAR(seconds[i], target, 0.25 * target) << "frame " << i;
    }
}

TEST(FrameTimes, AreReachedWithinTenFrames) {
    for (const double speed : {0.1, 0.3, 1.0, 3.0}) {
        Simulated device;
        device.photon /= speed;
        device.pixel /= speed;
        FrameTime control(0.05, limits);
        expect_within(run(control, device, 40), 10, 0.05);
    }
}

TEST(FrameTimes, DoNotSwing) {
    Simulated device;
    device.noise = 0.08;
    FrameTime control(0.05, limits);
    run(control, device, 10);
    int changes = 0;
    for (int i = 0; i < 100; ++i) {
        const PreviewSize before = control.next();
        control.add(device.time(before));
        changes += before != control.next() ? 1 : 0;
    }
    EXPECT_LE(changes, 10);
}

TEST(FrameTimes, FollowADeviceThatBecomesTenTimesSlower) {
    Simulated device;
    FrameTime control(0.2, limits);
    run(control, device, 20);
    device.photon *= 10;
    device.pixel *= 10;
    expect_within(run(control, device, 30), 10, 0.2);
    device.photon /= 10;
    device.pixel /= 10;
    const std::vector<double> seconds = run(control, device, 30);
    expect_within(seconds, 10, 0.2);
}

TEST(FrameTimes, StopAtTheLimits) {
    Simulated device;
    device.rest = 1; // more than a frame may take
    FrameTime hopeless(0.05, limits);
    run(hopeless, device, 20);
    EXPECT_EQ(hopeless.next(), (PreviewSize{limits.least_scale, limits.least_photons}));
    FrameTime idle(100, limits);
    device.rest = 0;
    run(idle, device, 20);
    EXPECT_EQ(idle.next(), (PreviewSize{1, limits.most_photons}));
}

TEST(FrameTimes, NeedNoPhotons) {
    PreviewLimits none = limits;
    none.least_photons = none.most_photons = 0;
    FrameTime control(0.05, none);
    for (int i = 0; i < 20; ++i) {
        const PreviewSize size = control.next();
        EXPECT_EQ(size.photons, 0u);
        control.add({0, 1e-6 * size.scale * size.scale * static_cast<double>(limits.pixels), 0});
    }
    const double scale = control.next().scale;
    EXPECT_NEAR(1e-6 * scale * scale * static_cast<double>(limits.pixels), 0.05, 0.0125);
}

TEST(FrameTimes, OfAPictureOfOnePixel) {
    PreviewLimits pixel = limits;
    pixel.pixels = 1;
    FrameTime control(0.05, pixel);
    for (int i = 0; i < 20; ++i) {
        const PreviewSize size = control.next();
        EXPECT_TRUE(std::isfinite(size.scale) && size.scale > 0 && size.scale <= 1);
        control.add({0, 0, 0}); // no clock is that exact
    }
}

} // namespace
} // namespace argand
