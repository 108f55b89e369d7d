#pragma once

#include "image/image.hpp"
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace argand {

/// Distance of image A from the reference B. Means are over all pixels and channels, in double
/// precision.
struct Metrics {
    double rel_mse = 0;   ///< mean((a − b)² / (b² + 0.01·mean(b)²))
    double rmse = 0;      ///< sqrt(mean((a − b)²))
    double mae = 0;       ///< mean(|a − b|)
    double psnr = 0;      ///< [dB] 20·log10(peak / rmse), peak the largest value of B
    double ssim = 0;      ///< structural similarity of the displayed luminance, see `ssim`
    glm::dvec3 mean_a{0}; ///< mean radiance per channel
    glm::dvec3 mean_b{0}; ///< mean radiance per channel
};

/// Compares A with the reference B. If B is black, the denominator of relMSE is 0: then an equal
/// pixel counts as 0 and any other as infinity. The PSNR of equal images is infinity. Throws Error
/// if the sizes differ, an image is empty, or a pixel is not finite; the message names the files as
/// `name_a` and `name_b` do, and the first such pixel.
Metrics compare(const Image& a, const Image& b, std::string_view name_a = "A",
                std::string_view name_b = "B");

/// relMSE as in Metrics against two references with independent noise: the mean of
/// (image − a)(image − b) / (r² + 0.01·mean(r)²), where r is the mean of a and b. The noise of the
/// references does not add to the result, because its product is 0 on average; the noise of r in
/// the denominator should be small. Throws as `compare` does.
double rel_mse(const Image& image, const Image& reference_a, const Image& reference_b);

/// Unbiased sample variance of two or more independent images of the same scene, with the
/// denominator of `rel_mse`. The mean of their relMSE minus this is their squared bias. Throws as
/// `compare` does, and if there are fewer than two images.
double rel_variance(std::span<const Image> images, const Image& reference_a,
                    const Image& reference_b);

/// Per pixel, the mean over channels of (a − b)(c − d) / (r² + 0.01·mean(r)²), where r is
/// `reference`. Noise that is independent in the two differences averages to 0. Throws as `compare`
/// does.
std::vector<double> rel_products(const Image& a, const Image& b, const Image& c, const Image& d,
                                 const Image& reference);

/// Mean structural similarity (Wang et al. 2004, "Image Quality Assessment: From Error Visibility
/// to Structural Similarity") of the sRGB-encoded luminance, clamped to [0, 1]: Gaussian window of
/// 11 × 11, σ = 1.5, K1 = 0.01, K2 = 0.03, averaged over all positions where the window lies within
/// the image. Along a side that is shorter than the window, the window has the longest odd length
/// that fits. The images must have one size and must not be empty.
double ssim(const Image& a, const Image& b);

/// Image of the difference, for display: black where A equals B, red where A is brighter, blue
/// where it is darker. The colour is full where the luminances differ by sqrt(b² + 0.01·mean(b)²)
/// or more. Throws as `compare` does.
Image difference_picture(const Image& a, const Image& b, std::string_view name_a = "A",
                         std::string_view name_b = "B");

} // namespace argand
