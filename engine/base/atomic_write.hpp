#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <sys/types.h>

namespace argand {

/// Writes a file in one step: the bytes go to a new file beside the target, which is then renamed
/// to the target. Whatever happens, the target holds either its old content or all of the new.
/// Symbolic links are followed; an existing file keeps its permissions; a pipe or device is written
/// to directly. Throws Error, and leaves no file behind, if the target is a directory or is
/// write-protected, if its directory does not exist or is write-protected, or if the disk is full.
void write_atomically(const std::filesystem::path& target, std::span<const std::uint8_t> bytes);
void write_atomically(const std::filesystem::path& target, std::string_view text);

/// A new file beside a target, to be written by whoever knows its path and then put in the target's
/// place. Removed at the end of its life if it is not put there.
class Replacement {
public:
    /// Throws the errors of `write_atomically`, and Error if the target is a pipe or a device.
    explicit Replacement(const std::filesystem::path& target);
    ~Replacement();
    Replacement(const Replacement&) = delete;
    Replacement& operator=(const Replacement&) = delete;

    const std::filesystem::path& path() const { return path_; }
    int descriptor() const { return descriptor_; } ///< open for writing

    /// Adds these bytes. Throws Error, for example if the disk is full.
    void write(std::span<const std::uint8_t> bytes);

    /// Renames it to the target; once only. Throws Error, and leaves the target as it was, if that
    /// fails.
    void put_in_place();

private:
    std::filesystem::path target_;      ///< as the user calls it
    std::filesystem::path destination_; ///< after its symbolic links, which stay links
    std::filesystem::path path_;        ///< empty once it is in place
    std::optional<mode_t> mode_;        ///< permissions of the file in whose place it goes
    int descriptor_ = -1;
};

/// Throws the Error that `write_atomically` would throw, as far as it can be known beforehand. Call
/// it before hours of work.
void check_writable(const std::filesystem::path& target);

} // namespace argand
