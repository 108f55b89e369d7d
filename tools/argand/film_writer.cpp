#include "film_writer.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "image/files.hpp"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace argand {

namespace {

constexpr const char* remedy = "write frame_%04d.png";

std::string printable(const std::string& name) { return one_line(name, 4096); }

std::vector<std::string> ffmpeg_command(const std::string& name, const std::string& file,
                                        const PictureSize& size, double frames_per_second) {
    std::vector<std::string> command{"ffmpeg", "-hide_banner", "-loglevel",
                                     "error",  "-nostdin",     "-y"};
    const auto add = [&](std::initializer_list<std::string> more) {
        command.insert(command.end(), more);
    };
    add({"-f", "rawvideo", "-pix_fmt", "rgb24", "-s", fmt::format("{}x{}", size.width, size.height),
         "-r", fmt::format("{}", frames_per_second), "-i", "-"});
    // yuv420p, which all players know, has one colour for 2 x 2 pixels. Without the matrix and the
    // tags, ffmpeg takes the matrix of standard definition, and players guess.
    add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
         "-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc",
         "iec61966-2-1", "-color_range", "tv"});
    if (lower_extension(name) == ".mp4") {
        add({"-c:v", "libx264", "-movflags", "+faststart", "-f", "mp4"});
    } else {
        // Without these two, ffmpeg may keep to 200 kbit/s.
        add({"-c:v", "libvpx-vp9", "-crf", "31", "-b:v", "0", "-f", "webm"});
    }
    // Without "file:", a directory named "a:" would be taken for a protocol, and '-' for an option.
    add({"file:" + file});
    return command;
}

std::unique_ptr<ChildProcess> start_ffmpeg(const std::string& name, const std::string& file,
                                           const PictureSize& size, double frames_per_second) {
    try {
        return std::make_unique<ChildProcess>(ffmpeg_command(name, file, size, frames_per_second));
    } catch (const std::system_error& error) {
        if (error.code().value() == ENOENT) {
            fail("writing '{}': ffmpeg is not installed or not on the PATH; install it, or {}",
                 printable(name), remedy);
        }
        fail("writing '{}': ffmpeg cannot be started: {}; {}", printable(name),
             error.code().message(), remedy);
    }
}

} // namespace

bool is_film(const std::string& name) {
    const std::string extension = lower_extension(name);
    return extension == ".mp4" || extension == ".webm";
}

FilmWriter::FilmWriter(std::string name, const PictureSize& size, double frames_per_second)
    : name_(std::move(name)), file_(name_),
      ffmpeg_(start_ffmpeg(name_, file_.path().string(), size, frames_per_second)) {}

void FilmWriter::add(std::span<const std::uint8_t> pixels) {
    if (!ffmpeg_->send(pixels)) {
        fail_unfinished();
    }
}

void FilmWriter::finish() {
    if (!ffmpeg_->wait() || !ffmpeg_->failure().empty()) {
        fail_unfinished();
    }
    std::error_code missing;
    if (std::filesystem::file_size(file_.path(), missing) == 0 || missing) {
        fail_of_ffmpeg("it wrote nothing");
    }
    file_.put_in_place();
}

void FilmWriter::fail_unfinished() {
    if (!ffmpeg_->wait()) {
        fail("writing '{}': interrupted before the film was complete, so it is not written; to be "
             "able to --continue, {}",
             printable(name_), remedy);
    }
    const std::string failure = ffmpeg_->failure();
    fail_of_ffmpeg(failure.empty() ? "it ended before the last frame" : failure);
}

void FilmWriter::fail_of_ffmpeg(const std::string& failure) {
    fail("writing '{}': ffmpeg failed: {}; {} instead, or install another ffmpeg", printable(name_),
         failure, remedy);
}

} // namespace argand
