#pragma once

#include "image/image.hpp"

namespace argand {

/// Weighted mean of two images of one size. The sum of the weights must not be 0; a negative weight
/// removes an image from a mean that contains it.
Image weighted_mean(const Image& a, double weight_a, const Image& b, double weight_b);

/// Weighted sum of two images of one size.
Image weighted_sum(const Image& a, double weight_a, const Image& b, double weight_b);

/// Mean of two images of one size, with equal weights.
inline Image mean_of(const Image& a, const Image& b) { return weighted_mean(a, 1, b, 1); }

} // namespace argand
