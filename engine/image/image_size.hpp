#pragma once

#include "image/image.hpp"
#include <cstdint>
#include <filesystem>

namespace argand {

/// Longest side and largest number of samples (pixels × channels) that are read or written.
inline constexpr int longest_side = 65536;
inline constexpr std::uint64_t most_samples = std::uint64_t{1} << 30;

/// Error, naming the file to write, unless the picture has 1 … longest_side pixels a side and as
/// many pixels as its sides say.
void check_size_to_write(const std::filesystem::path& path, const Image& image);

} // namespace argand
