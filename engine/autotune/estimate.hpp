#pragma once

#include "image/image.hpp"

#include <array>
#include <limits>
#include <span>

namespace argand {

/// Two pictures of the same with independent noise.
using Pair = std::array<Image, 2>;

/// A number and its standard error; infinite: nothing is known of it.
struct Estimate {
    double value = 0;
    double error = std::numeric_limits<double>::infinity();
};

inline Estimate scaled(const Estimate& estimate, double by) {
    return {by * estimate.value, by * estimate.error};
}

/// What a positive number is likely to be that usually is `usual`, up to a factor of `factor` (one
/// standard deviation of its logarithm), but one time in twenty anything from a 10,000th to 10,000
/// times it, after independent estimates of it with normal errors (Bayes): the mean of its
/// logarithm.
Estimate posterior(double usual, double factor, std::span<const Estimate> estimates);

/// Mean over the pixels of (a[0] − b[0])(a[1] − b[1]), divided as in relMSE by what follows from
/// `reference`: the squared difference of what a and b are pictures of. First from the pictures as
/// they are; then from smoothed ones, without most of the noise of single pixels, times what
/// smoothing takes from the bias of density estimation.
std::array<Estimate, 2> squared_difference(const Pair& a, const Pair& b, const Image& reference);

/// The mean over 3 × 3 pixels.
Image smoothed(const Image& image);

/// What relMSE divides by, as far as two pictures tell: the root of the product of the two. Their
/// mean would take the bright dots that few paths or photons make for bright places, and the errors
/// there for small ones; so no more than 1.2 times the darker of the two.
Image guess_from(const Pair& pictures);

} // namespace argand
