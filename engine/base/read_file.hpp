#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace argand {

/// Reads a regular file, which may be empty. Throws Error if it is missing, is a directory or a
/// special file, or cannot be read.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path);

} // namespace argand
