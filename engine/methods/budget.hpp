#pragma once

#include "base/clock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace argand {

/// How often to repeat passes: as many as there are, or as often as fits in a time.
class Budget {
public:
    /// seconds: from now on; none: every pass once.
    explicit Budget(std::optional<double> seconds) : seconds_(seconds) {}

    /// Told where the first pass begins, after what is done once: that says nothing of how long
    /// passes take.
    void start_pass() { begun_ = elapsed(); }

    /// Does what is done once in the middle of the first pass, and leaves it out of the pass's
    /// time.
    template <typename Work> auto once(const Work& work) {
        const double before = elapsed();
        auto result = work();
        begun_ += elapsed() - before;
        return result;
    }

    /// Told after each pass, where the next one begins. Whether another is to be made; there is
    /// time for it, if it takes as long as the last one.
    bool another(std::uint64_t done, std::uint64_t passes) {
        if (!seconds_) {
            return done < passes;
        }
        const double now = elapsed();
        const double last = now - begun_;
        in_passes_ += last;
        begun_ = now;
        return now + last <= *seconds_;
    }

    /// Passes that there will be, as far as can be told when so many are done.
    double expected(std::uint64_t done, std::uint64_t passes) const {
        if (!seconds_ || done == 0) {
            return static_cast<double>(passes);
        }
        const double each = std::max(in_passes_ / static_cast<double>(done), 1e-9);
        return std::round(static_cast<double>(done) + std::max(*seconds_ - elapsed(), 0.0) / each);
    }

    /// Share of the work that is done, `part` of the current pass.
    double share(std::uint64_t done, double part, std::uint64_t passes) const {
        return seconds_ ? std::min(elapsed() / *seconds_, 1.0)
                        : (static_cast<double>(done) + part) / static_cast<double>(passes);
    }

private:
    double elapsed() const { return seconds_since(start_); }

    std::optional<double> seconds_;
    Clock::time_point start_ = Clock::now();
    double begun_ = 0, in_passes_ = 0;
};

/// Whether samples after so many passes still have numbers of 32 bits, beyond which they would be
/// the same again.
inline bool has_sample_numbers(std::uint64_t passes, std::uint32_t samples) {
    return (passes + 1) * samples <= 0xffffffffu;
}

} // namespace argand
