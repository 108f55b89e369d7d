#pragma once

#include "sweep/reference.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace argand {

/// A film whose frames are measured: frames 0 <= k < frames of a scene, at k / fps seconds.
struct DynamicScene {
    std::string name;
    std::filesystem::path file;
    double fps = 24;
    std::uint64_t frames = 1;
    std::vector<std::uint64_t> references; ///< frames that are compared with a reference, ascending
};

/// References by frame.
using FilmReferences = std::map<std::uint64_t, Reference>;

/// The errors of a frame, as means over its seeds. Squares are relative, as in relMSE.
struct FrameErrors {
    double rel_mse = 0;
    double variance = 0;     ///< between seeds
    double squared_bias = 0; ///< relMSE without the variance; around 0 it may be negative
    /// relMSE of the change from the frame before, relative to the mean of both truths; none if
    /// that frame has no reference.
    std::optional<double> flicker;
    /// Frames by which the image is late: of the truths up to this frame that are known, that of
    /// `frame - lag` is the nearest to it.
    std::uint64_t lag = 0;
};

/// What a frame of a film took, as means over its seeds (bytes: of the first seed).
struct MeasuredFrame {
    std::uint64_t frame = 0;
    double seconds = 0;        ///< from the moved scene to the image
    double update_seconds = 0; ///< moving the scene and its tree; not part of `seconds`
    std::map<std::string, double> stage_seconds; ///< of the device's time stamps
    std::uint64_t peak_bytes = 0;                ///< of all frames so far
    double photons_emitted = 0, photons_stored = 0;
    std::optional<FrameErrors> errors;
};

/// Renders the references of a film: two images for each by reference_method(), with `samples`
/// samples each. Keeps them in `folder` and takes those that it finds there. Returns nothing if it
/// was interrupted. Throws Error if a kept file is damaged.
std::optional<FilmReferences> film_references(const OpenDevice& open, const DynamicScene& film,
                                              RenderSettings settings, std::uint32_t samples,
                                              const std::filesystem::path& folder,
                                              const std::function<bool()>& keep_going,
                                              MethodTable methods = builtin_methods());

/// Renders the film once for each of two or more seeds, by one session each, and measures its
/// frames. A first frame, which is not measured, compiles the kernels. Returns nothing if it was
/// interrupted.
std::optional<std::vector<MeasuredFrame>>
measure_film(const OpenDevice& open, const DynamicScene& film, const RenderSettings& settings,
             std::span<const std::uint32_t> seeds, const FilmReferences& references,
             const std::function<bool()>& keep_going, MethodTable methods = builtin_methods());

/// The errors of frame `frame`, whose images by seed are given with those of the frame before
/// (empty: none). The frame has a reference. For measure_film().
FrameErrors errors_of(std::uint64_t frame, std::span<const Image> images,
                      std::span<const Image> images_before, const FilmReferences& references);

} // namespace argand
