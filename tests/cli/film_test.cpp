// Films that ffmpeg makes: argand render --frames -o film.mp4. A script takes the place of ffmpeg.
#include "argand_run.hpp"

#include "image/files.hpp"
#include "image/png.hpp"

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <sys/stat.h>

namespace argand::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Films : public ArgandTest {
protected:
    /// Leaves its arguments, a line each, its process and its group in $LOG, and its input, as it
    /// is, in the film.
    static constexpr const char* recorder = R"(
for last; do :; done
printf '%s\n' "$@" >"$LOG/arguments"
echo $$ >"$LOG/process"
cut -d ' ' -f 5 "/proc/$$/stat" >"$LOG/group"
cat >"${last#file:}"
)";

    /// Makes this script ffmpeg.
    void ffmpeg_is(const std::string& script) const {
        const std::filesystem::path program = programs_ / "ffmpeg";
        write_text(program, "#!/bin/sh\n" + script);
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    }
    std::string environment() const {
        return std::string(on_host) + " PATH='" + programs_.path().string() + "':\"$PATH\" LOG='" +
               log_.path().string() + "'";
    }
    static std::string film(const std::string& options) {
        return "render '" + asset("moving_light.glb") + "' --spp 1 --photons 500 -q " + options;
    }
    Outcome run(const std::string& options) const { return argand(film(options), environment()); }

    /// Expects that ffmpeg's failure is told so, and that a film that was there is left alone.
    void expect_told(const std::string& script, const std::string& text) const {
        ffmpeg_is(script);
        write_text(file("film.mp4"), "older film");
        // A frame fills more than a pipe.
        expect_failure(film("--size 200x200 --frames 0:2 -o film.mp4"), failure,
                       "writing 'film.mp4': ffmpeg failed: " + text +
                           "; write frame_%04d.png instead",
                       environment());
        EXPECT_EQ(read_text(file("film.mp4")), "older film");
    }

    /// Interrupts a render once there is a file in $LOG, and expects that nothing is left of the
    /// film, nor of ffmpeg.
    void expect_interruptible(const std::string& frames, const std::string& script) const {
        SCOPED_TRACE(script);
        ffmpeg_is("echo $$ >\"$LOG/process\"\n" + script);
        std::filesystem::remove(log_ / "ready");
        // A shell without job control ignores SIGINT, and so do its children: hence SIGTERM.
        const std::string command =
            "--version >/dev/null; " + environment() + " '" ARGAND_EXECUTABLE "' " +
            film("--size 200x200 -o film.mp4 --frames " + frames) +
            " 2>error & film=$!; while kill -0 $film && ! test -e '" + (log_ / "ready").string() +
            "'; do sleep 0.05; done; sleep 0.2; kill -TERM $film; wait $film";
        const Outcome outcome = argand(command);
        const std::string error = read_text(file("error"));
        std::filesystem::remove(file("error"));
        EXPECT_EQ(outcome.exit_code, failure) << error;
        EXPECT_THAT(error, HasSubstr("interrupted"));
        EXPECT_THAT(error, HasSubstr("write frame_%04d.png"));
        EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
        EXPECT_EQ(files(), std::vector<std::string>{});
        const pid_t process = std::stoi(logged("process"));
        EXPECT_TRUE(::kill(process, 0) != 0 && errno == ESRCH) << process;
    }

    /// The text of a file in $LOG.
    std::string logged(const std::string& name) const { return read_text(log_ / name); }
    /// Three bytes for each pixel of a PNG.
    std::string pixels(const std::string& name) const {
        const std::vector<std::uint8_t> bytes = srgb_bytes(read_png(file(name)), {});
        return {bytes.begin(), bytes.end()};
    }

private:
    ScratchDirectory programs_, log_;
};

TEST_F(Films, HaveTheFramesOfThePictures) {
    ffmpeg_is(recorder);
    const Outcome outcome = run("--size 7x5 --frames 3:6 --fps 12.5 --exposure 1 --seed-per-frame "
                                "-o a.mp4 -o f%d.png -o b.webm -o f%d.exr --json f.json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_EQ(files(), (std::vector<std::string>{"a.mp4", "b.webm", "f.json", "f3.exr", "f3.png",
                                                 "f4.exr", "f4.png", "f5.exr", "f5.png"}));
    const std::string film = read_text(file("a.mp4"));
    EXPECT_EQ(film.size(), 3u * 7 * 5 * 3);
    EXPECT_TRUE(film == pixels("f3.png") + pixels("f4.png") + pixels("f5.png"));
    EXPECT_TRUE(film == read_text(file("b.webm")));
    EXPECT_THAT(read_text(file("f.json")),
                HasSubstr(R"("outputs":["a.mp4","f4.png","b.webm","f4.exr"])"));
}

TEST_F(Films, SayToFfmpegWhatTheyAre) {
    ffmpeg_is(recorder);
    ASSERT_EQ(run("--size 7x5 --frames 0:1 --fps 12.5 -o a.mp4").exit_code, 0);
    const std::string mp4 = logged("arguments");
    EXPECT_THAT(mp4, HasSubstr("-f\nrawvideo\n-pix_fmt\nrgb24\n-s\n7x5\n-r\n12.5\n-i\n-\n"));
    EXPECT_THAT(mp4, HasSubstr("pad=ceil(iw/2)*2:ceil(ih/2)*2"));
    EXPECT_THAT(mp4, HasSubstr("-pix_fmt\nyuv420p\n"));
    EXPECT_THAT(mp4, HasSubstr("-c:v\nlibx264\n-movflags\n+faststart\n-f\nmp4\nfile:"));
    EXPECT_THAT(mp4, Not(HasSubstr("a.mp4")));
    // The terminal sends Ctrl-C to Argand's group.
    EXPECT_EQ(logged("group"), logged("process"));
}

TEST_F(Films, OfWebmAreVp9) {
    ffmpeg_is(recorder);
    ASSERT_EQ(run("--size 8x8 --frames 0:1 -o b.WebM").exit_code, 0);
    EXPECT_THAT(logged("arguments"), HasSubstr("-c:v\nlibvpx-vp9\n"));
    EXPECT_THAT(logged("arguments"), HasSubstr("-f\nwebm\n"));
}

TEST_F(Films, MayHaveAnyName) {
    ffmpeg_is(recorder);
    std::filesystem::create_directory(file("a:b"));
    for (const std::string name :
         {"-x.mp4", "two words.mp4", R"x(it's "$(touch oops)";.webm)x", "100%d.mp4", "a:b/c.MP4"}) {
        std::string quoted;
        for (const char letter : name) {
            quoted += letter == '\'' ? R"('\'')" : std::string(1, letter);
        }
        const Outcome outcome = run("--size 4x4 --frames 0:2 -o '" + quoted + "'");
        EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
        EXPECT_EQ(read_text(file(name)).size(), 2u * 4 * 4 * 3) << name;
    }
    EXPECT_EQ(files().size(), 5u);
}

TEST_F(Films, KeepThePermissionsOfThoseTheyReplace) {
    ffmpeg_is(recorder);
    write_text(file("a.mp4"), "older film");
    const auto only_mine = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
    std::filesystem::permissions(file("a.mp4"), only_mine);
    ASSERT_EQ(run("--size 4x4 --frames 0:1 -o a.mp4").exit_code, 0);
    EXPECT_EQ(read_text(file("a.mp4")).size(), 48u);
    EXPECT_EQ(std::filesystem::status(file("a.mp4")).permissions(), only_mine);
}

TEST_F(Films, NeedFfmpegBeforeAnythingIsRendered) {
    expect_failure(film("--size 8x8 --frames 0:2 -o f%d.png -o film.mp4"), failure,
                   "writing 'film.mp4': ffmpeg is not installed or not on the PATH; install it, or "
                   "write frame_%04d.png",
                   std::string(on_host) + " PATH=/nonexistent");
    EXPECT_EQ(argand(film("--size 8x8 --frames 0:1 -o f%d.png"),
                     std::string(on_host) + " PATH=/nonexistent")
                  .exit_code,
              0);
}

TEST_F(Films, TellHowFfmpegFailed) {
    expect_told(R"(cat >/dev/null; echo first >&2; printf 'the \033[1mlast\tline\n\n' >&2; exit 3)",
                "the [1mlast line");
    expect_told("cat >/dev/null; exit 3", "it ended with status 3");
    expect_told("cat >/dev/null; echo a warning >&2; kill -KILL $$", "it was ended by signal 9");
}

TEST_F(Films, TellThatFfmpegEndedEarly) {
    expect_told("head -c 10 >/dev/null", "it ended before the last frame");
    expect_told("cat >/dev/null", "it wrote nothing");
    expect_told("exec <&-; echo Unknown encoder >&2; exit 1", "Unknown encoder");
}

TEST_F(Films, AreMadeByAnFfmpegThatSaysALot) {
    ffmpeg_is("head -c 1000000 /dev/zero | tr '\\0' x >&2" + std::string(recorder) +
              "head -c 1000000 /dev/zero >&2");
    const Outcome outcome = run("--size 200x200 --frames 0:2 -o film.mp4");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.error, "");
    EXPECT_EQ(read_text(file("film.mp4")).size(), 2u * 200 * 200 * 3);
}

TEST_F(Films, LeaveNothingBehindWhenInterrupted) {
    expect_interruptible("0:100000", "head -c 200000 >/dev/null; touch \"$LOG/ready\"; cat");
    // It stops reading, or does not end.
    expect_interruptible("0:100000", "touch \"$LOG/ready\"; sleep 1000");
    expect_interruptible("0:2", "cat >/dev/null; touch \"$LOG/ready\"; sleep 1000");
}

TEST_F(Films, WrongOptionsAreUsageErrors) {
    const auto expect_usage = [&](const std::string& options, const char* text) {
        expect_failure("render '" + asset("moving_light.glb") + "' " + options, usage, text);
    };
    expect_usage("--frames 0:2 --continue -o film.mp4",
                 "write frame_%04d.png and --continue those");
    expect_usage("--frames 0:2 --continue -o f%d.png -o film.webm", "'film.webm' cannot be");
    expect_usage("-o film.mp4", "--frames A:B for a film");
    expect_usage("-o film.webm --at 1", "--frames A:B for a film");
    expect_usage("--frames 0:2 -o film.mp4 -o ./film.mp4", "it would replace 'film.mp4'");
    expect_usage("--frames 0:2 -o film.mp4 --json film.mp4", "it would replace 'film.mp4'");
    expect_usage("--frames 0:2 -o film.mov", "one place for the frame's number");
    write_text(file("scene.mp4"), "");
    expect_failure("render scene.mp4 --frames 0:2 -o scene.mp4", usage, "it would replace");
}

TEST_F(Films, AreWrittenToFiles) {
    ffmpeg_is(recorder);
    ASSERT_EQ(::mkfifo(file("pipe.mp4").c_str(), 0600), 0);
    expect_failure(film("--frames 0:2 -o pipe.mp4"), failure, "it is a pipe or a device",
                   environment());
    expect_failure(film("--frames 0:2 -o no/film.mp4"), failure, "the directory 'no' does not",
                   environment());
}

} // namespace
} // namespace argand::testing
