#pragma once

#include "image/image.hpp"
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace argand {

/// Reads .exr (all layers), .png or .hdr (one layer, "") by the file's extension, whatever its
/// case. UsageError for another extension, Error for what cannot be read.
std::vector<Layer> read_image(const std::filesystem::path& path);

/// Writes .exr (all layers, linear) or .png (the layer "", or the first if there is none of that
/// name, after an exposure of 2^exposure_ev) by the file's extension. UsageError for another
/// extension, Error if it cannot be written.
void write_image(const std::filesystem::path& path, std::span<const Layer> layers,
                 float exposure_ev = 0);

/// Fails now as `write_image` would after hours of rendering: unknown extension, directory missing
/// or not writable.
void check_image_writable(const std::filesystem::path& path);

/// The layer of that name, or null.
const Image* find_layer(std::span<const Layer> layers, std::string_view name);

} // namespace argand
