#pragma once

#include "image/image.hpp"

#include <array>
#include <limits>
#include <span>

namespace argand {

/// A number and its standard error; infinite: nothing is known of it.
struct Estimate {
    double value = 0;
    double error = std::numeric_limits<double>::infinity();
};

inline Estimate scaled(const Estimate& estimate, double by) { return {by * estimate.value, by * estimate.error}; }

/// The mean of independent estimates of one number, by their errors.
Estimate pooled(std::span<const Estimate> estimates);

/// Mean over the pixels of (a[0] − b[0])(a[1] − b[1]), divided as in relMSE by what follows from `reference`: the squared
/// difference of what a and b are pictures of, if all four have independent noise. The pictures are smoothed first, which takes
/// most of the noise of single pixels and little of what estimation over many pixels does.
Estimate squared_difference(const std::array<Image, 2>& a, const std::array<Image, 2>& b, const Image& reference);

/// The mean over 3 × 3 pixels.
Image smoothed(const Image& image);

} // namespace argand
