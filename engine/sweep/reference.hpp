#pragma once

#include "sweep/trials.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace argand {

/// The true picture as far as it is known: twice, with independent noise, so that the noise does
/// not count as error.
struct Reference {
    Image a, b;
    std::uint64_t samples = 0; ///< of both together, per pixel; 0: not known
    std::optional<double>
        own_error; ///< relMSE that their mean has from noise; none: there is one picture only

    Image mean() const;
};

/// relMSE of a picture whose values are each off by the rounding of single precision, 2^-24 of
/// them.
inline constexpr double rounding_error = 0x1p-48;

/// The relMSE below which pictures cannot be told apart against this reference. That of a true
/// picture is the mean of products of the pair's independent noises, each of twice `own_error`; it
/// is 0 on average, and its standard deviation is about 2 own_error / sqrt(n), where n is the
/// number of pixels that have a part in the noise. Told as (Σx)² / Σx² from the pair's squared
/// differences x it is too small a number, so that this is about two standard deviations of normal
/// noise. Not above own_error, nor below `rounding_error`, which it is where the own error is not
/// known.
double least_error_of(const Reference& reference);

/// A reference is good enough once its own error is this share of the least error that is to be
/// measured.
inline constexpr double reference_share = 0.1;

/// Renders a pair by the first unbiased method, with more and more samples until its own error is
/// `reference_share` of the least relMSE of `pilots`, the best pictures that are going to be
/// measured, or `seconds` are over. Nothing if it was interrupted.
std::optional<Reference> render_reference(const RenderTrials& render, const RenderSettings& base,
                                          std::span<const Image> pilots, double seconds,
                                          MethodTable methods = builtin_methods());

/// Reads a reference from picture files: one, or a pair of independent noise. Error if it is not of
/// the size, or the sizes differ.
Reference read_reference(const std::vector<std::filesystem::path>& files, int width, int height);

/// Keeps a pair in one OpenEXR file, and finds it again. Error, which says that it may be removed,
/// if it is not one.
void write_reference(const std::filesystem::path& file, const Reference& reference);
Reference reread_reference(const std::filesystem::path& file);

} // namespace argand
