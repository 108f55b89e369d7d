#pragma once

#include "base/clock.hpp"

#include <string>
#include <string_view>

namespace argand {

/// Shows the progress of work as one line on a terminal, "tracing photons  42 %  12 s left". The
/// line is redrawn in place at most ten times a second and erased at the end. Prints nothing if
/// `quiet` is set or the output is not a terminal.
class Progress {
public:
    explicit Progress(std::string work, bool quiet = false, int descriptor = 2);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Whether anything is shown.
    bool is_shown() const { return active_; }

    /// Reports the share of the work that is done, clamped to [0, 1].
    /// detail: a few words on the work so far.
    void update(double fraction, std::string_view detail = {});

    /// Erases the line; also done on destruction.
    void erase();

private:
    std::string work_;
    int descriptor_;
    bool active_;
    bool drawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_drawn_{};
};

/// The line that `Progress` draws after `seconds` of work.
std::string progress_line(std::string_view work, double fraction, double seconds,
                          std::string_view detail = {});

} // namespace argand
