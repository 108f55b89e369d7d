#pragma once

#include "image/picture_settings.hpp"
#include "methods/render_settings.hpp"
#include "picture_size.hpp"
#include "session/features.hpp"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace argand {

/// How the user wants pictures to be written.
struct PictureOptions {
    float exposure = 0;     ///< in stops
    bool automatic = false; ///< the exposure is found in each picture
    Tone tone = Tone::linear;
    FeatureLayers layers; ///< of the .exr, beside radiance
    std::string crop;     ///< "X0,Y0,X1,Y1"; empty: the whole picture
    std::string command;  ///< that the user typed, for the files
};

/// Adds --exposure and --tone.
void add_display_options(CLI::App& command, PictureOptions& options);

/// Adds these, --aovs and --crop.
void add_picture_options(CLI::App& command, PictureOptions& options);

/// The part of a picture of this size that the user asked for, if any. Throws UsageError unless it
/// lies within and is not empty.
std::optional<CropRectangle> parse_crop(const std::string& crop, const PictureSize& size);

/// How this picture, of these settings, is to be written.
PictureSettings picture_settings(const PictureOptions& options, const RenderSettings& settings,
                                 const Image& picture);

/// The arguments as a line that a shell reads, with the name of the program at its front.
std::string command_text(int argc, const char* const* argv);

} // namespace argand
