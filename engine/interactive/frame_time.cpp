#include "interactive/frame_time.hpp"

#include <algorithm>
#include <cmath>

namespace argand {

namespace {

constexpr double photons_share = 0.4;
// A size is aimed at this share of the time, and kept between the two others.
constexpr double aim = 0.9, least_used = 0.75, most_used = 1.05;
// Scales are multiples of one over this, so that small changes of load do not change the picture.
constexpr double scale_steps = 32;

/// Follows slow changes smoothly and jumps at once.
void follow(double& estimate, double measured) {
    constexpr double jump = 2;
    const bool jumps = measured > jump * estimate || measured * jump < estimate;
    estimate = jumps ? measured : (estimate + measured) / 2;
}

/// To two digits.
std::uint64_t rounded(double photons) {
    const double step = std::pow(10, std::floor(std::log10(std::max(photons, 1.0))) - 1);
    return static_cast<std::uint64_t>(std::max(std::round(photons / step) * step, 1.0));
}

} // namespace

FrameTime::FrameTime(double seconds, const PreviewLimits& limits)
    : seconds_(seconds), limits_(limits),
      // Small enough to be soon over on a processor; the first preview tells what it cost.
      size_{std::max(limits.least_scale, 0.25),
            std::clamp<std::uint64_t>(10'000, limits.least_photons, limits.most_photons)} {}

double FrameTime::pixels(double scale) const {
    return scale * scale * static_cast<double>(limits_.pixels);
}

double FrameTime::expected(const PreviewSize& size) const {
    return photon_ * static_cast<double>(size.photons) + pixel_ * pixels(size.scale) + rest_;
}

void FrameTime::add(const PreviewTime& time) {
    if (size_.photons > 0) {
        follow(photon_, time.photons / static_cast<double>(size_.photons));
    }
    follow(pixel_, time.pixels / std::max(pixels(size_.scale), 1.0));
    follow(rest_, time.rest);
    const PreviewSize better = best();
    const double now = expected(size_);
    // Between the bounds a size is kept. Below, only a larger one is better; limits may forbid it.
    if (now > most_used * seconds_ || now < least_used * seconds_) {
        size_ = better;
    }
}

PreviewSize FrameTime::best() const {
    const auto least = static_cast<double>(limits_.least_photons);
    const auto most = static_cast<double>(limits_.most_photons);
    // Where even the rest takes too long, the smallest preview is the best one.
    const double left = std::max(aim * seconds_ - rest_, 0.0);
    const double of_photon = std::max(photon_, 1e-12), of_pixel = std::max(pixel_, 1e-12);
    double photons = std::clamp(photons_share * left / of_photon, least, most);
    const double full = static_cast<double>(limits_.pixels);
    const double lowest = pixels(limits_.least_scale);
    const double count = std::clamp((left - photons * photon_) / of_pixel, lowest, full);
    const double steps = std::floor(std::sqrt(count / full) * scale_steps + 1e-9);
    const double scale = std::max(steps / scale_steps, limits_.least_scale);
    // What the pixels leave, the photons take; what they need more, the photons give.
    photons = std::clamp((left - pixels(scale) * pixel_) / of_photon, least, most);
    return {scale, most > 0 ? std::min(rounded(photons), limits_.most_photons) : 0};
}

} // namespace argand
