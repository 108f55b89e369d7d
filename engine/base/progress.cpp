#include "base/progress.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unistd.h>

namespace argand {

namespace {

constexpr std::chrono::milliseconds between_lines{100};
/// Share of the work that must be done before the time left is estimated; earlier it would jump.
constexpr double too_early = 0.01;

std::string duration(double seconds) {
    const long whole = std::lround(std::min(seconds, 1e9));
    if (whole < 60) {
        return fmt::format("{} s", whole);
    }
    if (whole < 3600) {
        return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    }
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

void print(int descriptor, std::string_view text) {
    // Progress that cannot be shown is no reason to fail.
    [[maybe_unused]] const ssize_t ignored = ::write(descriptor, text.data(), text.size());
}

} // namespace

std::string progress_line(std::string_view work, double fraction, double seconds,
                          std::string_view detail) {
    // Written so that NaN counts as nothing done.
    const double done = fraction > 0 ? std::min(fraction, 1.0) : 0.0;
    std::string line = fmt::format("{}  {:.0f} %", work, 100 * done);
    if (done >= too_early && done < 1) {
        line += fmt::format("  {} left", duration(seconds * (1 - done) / done));
    }
    return detail.empty() ? line : fmt::format("{}  {}", line, detail);
}

Progress::Progress(std::string work, bool quiet, int descriptor)
    : work_(std::move(work)), descriptor_(descriptor),
      active_(!quiet && ::isatty(descriptor) == 1) {}

Progress::~Progress() { erase(); }

void Progress::update(double fraction, std::string_view detail) {
    const Clock::time_point now = Clock::now();
    if (!active_ || (drawn_ && now - last_drawn_ < between_lines)) {
        return;
    }
    const double seconds = std::chrono::duration<double>(now - start_).count();
    print(descriptor_, "\r\x1b[K" + progress_line(work_, fraction, seconds, detail));
    drawn_ = true;
    last_drawn_ = now;
}

void Progress::erase() {
    if (drawn_) {
        print(descriptor_, "\r\x1b[K");
        drawn_ = false;
    }
}

} // namespace argand
