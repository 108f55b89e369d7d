#pragma once

#include "image/image.hpp"
#include <cstdint>
#include <filesystem>
#include <vector>

namespace argand {

/// Writes an 8-bit sRGB PNG in one step: the picture times 2^exposure_ev, clamped to [0, 1],
/// encoded, rounded to nearest; NaN becomes 0. Error if it cannot be written.
void write_png(const std::filesystem::path& path, const Image& image, float exposure_ev = 0);

/// What `write_png` would write. Error, naming the picture `name`, if it has no pixels or too many.
std::vector<std::uint8_t> png_bytes(const Image& image, float exposure_ev,
                                    const std::filesystem::path& name);

/// Reads a PNG of 8 or 16 bits as sRGB and returns linear values in [0, 1]; alpha is left out.
/// Error if the file is missing, damaged or not a PNG.
Image read_png(const std::filesystem::path& path);

/// Reads a Radiance RGBE picture (.hdr), linear. Error if the file is missing, damaged or not one.
Image read_hdr(const std::filesystem::path& path);

} // namespace argand
