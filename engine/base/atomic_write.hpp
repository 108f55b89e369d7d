#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace argand {

/// Writes a file in one step: the bytes go to a new file beside the target, which is then renamed
/// to the target. Whatever happens, the target holds either its old content or all of the new.
/// Symbolic links are followed; an existing file keeps its permissions; a pipe or device is written
/// to directly. Throws Error, and leaves no file behind, if the target is a directory or is
/// write-protected, if its directory does not exist or is write-protected, or if the disk is full.
void write_atomically(const std::filesystem::path& target, std::span<const std::uint8_t> bytes);
void write_atomically(const std::filesystem::path& target, std::string_view text);

/// Throws the Error that `write_atomically` would throw, as far as it can be known beforehand. Call
/// it before hours of work.
void check_writable(const std::filesystem::path& target);

} // namespace argand
