#pragma once

#include "image/picture_settings.hpp"
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace argand {

/// The extension of a file's name, such as ".png", with A to Z in lower case.
std::string lower_extension(const std::filesystem::path& path);

/// Reads a file in the format that its extension names, in upper or lower case: .exr (all layers),
/// .png or .hdr (one layer, ""). Throws UsageError for another extension, Error if the file cannot
/// be read.
std::vector<Layer> read_image(const std::filesystem::path& path);

/// Writes a file in the format that its extension names: .exr (all layers, linear) or .png (the
/// layer "", else the first one, as `display` says). Throws UsageError for another extension, Error
/// if the file cannot be written.
void write_image(const std::filesystem::path& path, std::span<const Layer> layers,
                 const PictureSettings& settings = {});

/// Throws now what `write_image` would throw after hours of rendering: the extension is unknown, or
/// the directory is missing or not writable.
void check_image_writable(const std::filesystem::path& path);

/// The image of the layer with that name, or null.
const Image* find_layer(std::span<const Layer> layers, std::string_view name);

/// The layer "", else the first one. There must be one.
const Image& whole_picture(std::span<const Layer> layers);

} // namespace argand
