#pragma once

#include "methods/method_info.hpp"
#include "sweep/trials.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace argand {

/// The reference image: twice, with independent noise, so that its noise does not count as error of
/// the images that are compared with it.
struct Reference {
    Image a, b;
    std::uint64_t samples = 0; ///< per pixel, of both together; 0: unknown
    /// relMSE of their mean due to noise. None if there is only one image.
    std::optional<double> own_error;

    Image mean() const;
};

/// relMSE of an image with a relative error of 2^-24, the rounding of single precision, in each
/// value.
inline constexpr double rounding_error = 0x1p-48;

/// The least relMSE that can be measured against this reference: images below it cannot be ranked.
/// The measured relMSE of a perfect image is the mean of products of the pair's independent noises,
/// each of variance 2 own_error. It is 0 on average, with a standard deviation of about
/// 2 own_error / sqrt(n), where n is the number of pixels that contribute to the noise. (Σx)² / Σx²
/// of the pair's squared differences x underestimates n, so that the result is about two standard
/// deviations for normal noise. It is at most own_error and at least `rounding_error`, which it is
/// if the own error is unknown.
double least_error_of(const Reference& reference);

/// A reference is good enough once its own error is this share of the least error of the pilots.
inline constexpr double reference_share = 0.1;

/// Renders a pair with a method without bias (reference_method()). Adds samples until its own error
/// is `reference_share` of the least relMSE of `pilots`, images about as good as the best that will
/// be measured, or until `seconds` are over. Nothing if it was interrupted.
std::optional<Reference> render_reference(const RenderTrials& render, const RenderSettings& base,
                                          std::span<const Image> pilots, double seconds,
                                          const MethodInfo& method);

/// Reads a reference from one image file, or from a pair with independent noise. Throws Error if an
/// image has another size.
Reference read_reference(const std::vector<std::filesystem::path>& files, int width, int height);

/// Writes a reference to an OpenEXR file of three layers: the mean, `a` and `b`.
void write_reference(const std::filesystem::path& file, const Reference& reference);
/// Reads the file that write_reference() wrote, without `samples` and `own_error`. Throws Error,
/// which says that the file may be removed, if it is anything else.
Reference reread_reference(const std::filesystem::path& file);

} // namespace argand
