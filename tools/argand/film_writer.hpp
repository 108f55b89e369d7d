#pragma once

#include "base/atomic_write.hpp"
#include "child_process.hpp"
#include "picture_size.hpp"

#include <memory>
#include <string>

namespace argand {

/// Whether the name is that of a film: .mp4 or .webm.
bool is_film(const std::string& name);

/// A film that ffmpeg makes. Appears only when it is complete; nothing is left behind otherwise.
class FilmWriter {
public:
    /// Starts ffmpeg. Throws Error if there is none, or if the file cannot be written.
    FilmWriter(std::string name, const PictureSize& size, double frames_per_second);

    /// Adds a frame: three bytes of sRGB for each pixel. Throws Error if ffmpeg has failed, or if
    /// Argand is interrupted meanwhile.
    void add(std::span<const std::uint8_t> pixels);

    /// Completes the film; once only. Throws as `add` does.
    void finish();

private:
    [[noreturn]] void fail_unfinished();
    [[noreturn]] void fail_of_ffmpeg(const std::string& failure);

    std::string name_;
    Replacement file_;
    std::unique_ptr<ChildProcess> ffmpeg_; ///< ends before its file is removed
};

} // namespace argand
