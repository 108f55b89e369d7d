#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace argand {

/// The bytes of a regular file (which may be empty). Error if it is missing, a directory or another
/// special file, or cannot be read.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path);

} // namespace argand
