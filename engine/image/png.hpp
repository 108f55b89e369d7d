#pragma once

#include "image/picture_settings.hpp"
#include <cstdint>
#include <filesystem>
#include <vector>

namespace argand {

/// Three bytes of sRGB for each pixel. Pixels are multiplied by 2^exposure_ev, put on the tone
/// curve, clamped to [0, 1], encoded and rounded to nearest; NaN becomes 0.
std::vector<std::uint8_t> srgb_bytes(const Image& image, const Display& display);

/// Writes a PNG of the `srgb_bytes` in one step (base/atomic_write.hpp), with the command as the
/// text "Comment". Throws Error if the file cannot be written.
void write_png(const std::filesystem::path& path, const Image& image,
               const PictureSettings& settings = {});

/// The bytes of the file that `write_png` writes. Throws Error, calling the image `name`, if it has
/// no pixels or too many.
std::vector<std::uint8_t> png_bytes(const Image& image, const PictureSettings& settings,
                                    const std::filesystem::path& name);

/// Reads an sRGB PNG with 8 or 16 bits per sample and returns linear values in [0, 1]. Alpha is
/// ignored. Throws Error if the file is missing, damaged or not a PNG.
Image read_png(const std::filesystem::path& path);

/// Reads a Radiance RGBE image (.hdr), which is linear. Throws Error if the file is missing,
/// damaged or not a Radiance file.
Image read_hdr(const std::filesystem::path& path);

} // namespace argand
