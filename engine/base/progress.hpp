#pragma once

#include "base/clock.hpp"

#include <string>
#include <string_view>

namespace argand {

/// One line on a terminal that says how far the work is, "tracing photons  42 %  12 s left",
/// redrawn in place at most ten times a second and erased at the end. Where the output is not a
/// terminal, or `quiet`, nothing is printed.
class Progress {
public:
    explicit Progress(std::string work, bool quiet = false, int descriptor = 2);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `fraction` of the work that is done, clamped to [0, 1].
    void update(double fraction);

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
std::string progress_line(std::string_view work, double fraction, double seconds);

} // namespace argand
