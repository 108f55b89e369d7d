#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace argand {

/// Writes a file in one step: the bytes go to a new file beside the target, which then takes the
/// target's name, so that whatever happens the target holds its old content or all of the new.
/// Through a symbolic link the file that it points to is replaced; an existing file keeps its
/// permissions; a pipe or device is written to directly. Error, with nothing left behind, if the
/// target is a directory, is write-protected, its directory does not exist or cannot be written to,
/// or the disk is full.
void write_atomically(const std::filesystem::path& target, std::span<const std::uint8_t> bytes);
void write_atomically(const std::filesystem::path& target, std::string_view text);

/// Fails as `write_atomically` would, as far as that can be known beforehand: for a check before
/// hours of work.
void check_writable(const std::filesystem::path& target);

} // namespace argand
