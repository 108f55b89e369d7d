#pragma once

#include "image/image.hpp"
#include <cstdint>
#include <filesystem>

namespace argand {

/// Longest side in pixels, and largest number of samples (pixels × channels), of an image file.
inline constexpr int longest_side = 65536;
inline constexpr std::uint64_t most_samples = std::uint64_t{1} << 30;

/// Throws Error, naming the file to write, unless both sides are 1 to longest_side pixels long and
/// the image has width × height pixels.
void check_size_to_write(const std::filesystem::path& path, const Image& image);

} // namespace argand
