#pragma once

#include "image/image.hpp"
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace argand {

/// How far picture A is from the reference B. Sums run in double precision over all pixels and
/// channels.
struct Metrics {
    double rel_mse = 0;   ///< mean((a − b)² / (b² + 0.01·mean(b)²))
    double rmse = 0;      ///< sqrt(mean((a − b)²))
    double mae = 0;       ///< mean(|a − b|)
    double psnr = 0;      ///< [dB] 20·log10(peak / rmse), peak the largest value of B
    double ssim = 0;      ///< structural similarity of the displayed luminance, see `ssim`
    glm::dvec3 mean_a{0}; ///< mean radiance per channel
    glm::dvec3 mean_b{0};
};

/// Compares A with the reference B. Where B is black (the denominator of relMSE is 0) an equal
/// pixel counts 0 and another one infinity; PSNR of equal pictures is infinity. Error, naming the
/// file and the first such pixel, if the sizes differ, a picture is empty or a pixel is not finite;
/// the names are the files'.
Metrics compare(const Image& a, const Image& b, std::string_view name_a = "A",
                std::string_view name_b = "B");

/// relMSE as in Metrics, of an image whose reference is known from two pictures of independent
/// noise: theirs does not count, as its product is 0 on average. (What is divided by is their mean,
/// whose noise should be small.) Errors as in `compare`.
double rel_mse(const Image& image, const Image& reference_a, const Image& reference_b);

/// Variance, without bias, of two or more independent pictures of one thing, divided pixel by pixel
/// as in that relMSE: so the mean of their relMSE less this is their squared bias. Errors as in
/// `compare`, and if there are fewer than two.
double rel_variance(std::span<const Image> images, const Image& reference_a,
                    const Image& reference_b);

/// (a − b)(c − d) of each pixel, the mean of its channels, divided as in relMSE by what follows
/// from `reference`: where the two differences have independent noise, it counts as 0 on average.
/// Errors as in `compare`.
std::vector<double> rel_products(const Image& a, const Image& b, const Image& c, const Image& d,
                                 const Image& reference);

/// Mean structural similarity (Wang et al. 2004, "Image Quality Assessment: From Error Visibility
/// to Structural Similarity") of the sRGB-encoded luminance, clamped to [0, 1]: Gaussian window of
/// 11 × 11, σ = 1.5, K1 = 0.01, K2 = 0.03, averaged over all places where the window lies within
/// the picture. Along a side shorter than the window, the window is the longest odd one that fits.
/// Both pictures must be of one size and not empty.
double ssim(const Image& a, const Image& b);

/// Their difference, to look at: black where A equals B, red where A is brighter, blue where it is
/// darker, in full colour where the luminances differ by sqrt(b² + 0.01·mean(b)²) or more. Errors
/// as in `compare`.
Image difference_picture(const Image& a, const Image& b, std::string_view name_a = "A",
                         std::string_view name_b = "B");

} // namespace argand
