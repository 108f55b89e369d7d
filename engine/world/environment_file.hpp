#pragma once

#include "scene/environment.hpp"

#include <filesystem>
#include <memory>

namespace argand {

/// Reads an equirectangular picture of the sky: a Radiance .hdr or the whole picture of an OpenEXR
/// .exr file. Throws UsageError for another extension, Error if the file cannot be read or a texel
/// is not a finite number or is negative.
std::shared_ptr<const SkyPicture> read_sky_picture(const std::filesystem::path& path);

} // namespace argand
