#pragma once

#include "image/image.hpp"

#include <array>
#include <limits>
#include <span>

namespace argand {

/// Two images of the same scene with independent noise.
using ImagePair = std::array<Image, 2>;

/// A number and its standard error. An infinite error means that nothing is known of the number.
struct Estimate {
    double value = 0;
    double error = std::numeric_limits<double>::infinity();
};

inline Estimate scaled(const Estimate& estimate, double by) {
    return {by * estimate.value, by * estimate.error};
}

/// What is known of a positive number before it is measured: it is log-normal around `usual`, with
/// a standard deviation of log(`factor`), but with the probability `unusual` it is uniform in the
/// logarithm from 1/10,000 to 10,000 times `usual`.
struct Prior {
    double usual = 0, factor = 1;
    double unusual = 0.05;
};

/// What is known of a positive number after it is measured (Bayes).
class Posterior {
public:
    /// estimates: independent estimates of the number with normal errors.
    Posterior(const Prior& prior, std::span<const Estimate> estimates);

    /// The exponential of the mean of its logarithm, with standard error. 0 if `usual` is 0.
    Estimate estimate() const;
    /// The probability that the number is at most `most`.
    double probability_below(double most) const;

private:
    double usual_;
    std::array<double, 2001> shifts_{}, weights_{}; ///< logarithms over that of `usual_`
};

/// Estimates the squared difference of the images that the pairs `a` and `b` show without noise:
/// the mean over the pixels of (a[0] − b[0])(a[1] − b[1]), divided as in relMSE by a denominator
/// computed from `reference`. The first estimate uses the images as they are. The second uses
/// smoothed images, which have lost most of the noise of single pixels, and makes up for the bias
/// of density estimation that smoothing removes. alike: whether the images of a pair differ by
/// their noise only, which tells the estimate's error better.
std::array<Estimate, 2> squared_difference(const ImagePair& a, const ImagePair& b,
                                           const Image& reference, bool alike = true);

/// The mean over 3 × 3 pixels.
Image smoothed(const Image& image);

/// Guesses the true image, for the denominator of relMSE: the geometric mean of the two images, at
/// most 1.2 times the darker one. Their mean would take fireflies for bright places, and the errors
/// there for small ones.
Image guess_from(const ImagePair& images);

/// The same for images of few passes: from smoothed images, because a penumbra may be black in one
/// of the two. Beside a lamp a pixel does not take the lamp's brightness: an error there counts as
/// what it is to the dark pixel.
Image guess_from_few(const ImagePair& images);

} // namespace argand
