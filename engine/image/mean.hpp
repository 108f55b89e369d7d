#pragma once

#include "image/image.hpp"

namespace argand {

/// The mean of two pictures of one size by weights whose sum is not 0. A negative weight takes b
/// out of a mean of which it is a part.
Image weighted_mean(const Image& a, double weight_a, const Image& b, double weight_b);

inline Image mean_of(const Image& a, const Image& b) { return weighted_mean(a, 1, b, 1); }

} // namespace argand
