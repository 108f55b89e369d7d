#pragma once

#include "tradeoff/trials.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace argand {

/// The true picture as far as it is known: twice, with independent noise, so that the noise does not count as error.
struct Reference {
    Image a, b;
    std::uint64_t samples = 0;              ///< of both together, per pixel; 0: not known
    std::optional<double> own_error;        ///< relMSE that their mean has from noise; none: there is one picture only

    Image mean() const;
};

/// A reference is good enough once its own error is this share of the least error that is to be measured.
inline constexpr double reference_share = 0.1;

/// Renders a pair by the method `path`, with more and more samples until its own error is `reference_share` of the least
/// relMSE of `pilots`, the best pictures that are going to be measured, or `seconds` are over. Nothing if it was
/// interrupted.
std::optional<Reference> render_reference(const RenderTrials& render, const RenderSettings& base,
                                          std::span<const Image> pilots, double seconds);

/// Reads a reference from picture files: one, or a pair of independent noise. Error if it is not of the size, or the
/// sizes differ.
Reference read_reference(const std::vector<std::filesystem::path>& files, int width, int height);

/// Keeps a pair in one OpenEXR file, and finds it again. Error, which says that it may be removed, if it is not one.
void write_reference(const std::filesystem::path& file, const Reference& reference);
Reference reread_reference(const std::filesystem::path& file);

} // namespace argand
