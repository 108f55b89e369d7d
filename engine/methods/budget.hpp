#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>

namespace argand {

/// How often to repeat passes: as many as there are, or as often as fits in a time.
class Budget {
public:
    /// seconds: from now on; none: every pass once.
    explicit Budget(std::optional<double> seconds) : seconds_(seconds) {}

    /// Told after each pass. Whether another is to be made; there is time for it, if it takes as long as the last one.
    bool another(std::uint64_t done, std::uint64_t passes) {
        if (!seconds_) {
            return done < passes;
        }
        const double now = elapsed();
        const double last = now - before_;
        before_ = now;
        return now + last <= *seconds_;
    }

    /// Passes that there will be in the time, as far as can be told when some are done.
    double expected(std::uint64_t done) const {
        return std::max(std::round(static_cast<double>(done) * *seconds_ / std::max(elapsed(), 1e-9)), 1.0);
    }

    /// Share of the work that is done, `part` of the current pass.
    double share(std::uint64_t done, double part, std::uint64_t passes) const {
        return seconds_ ? std::min(elapsed() / *seconds_, 1.0)
                        : (static_cast<double>(done) + part) / static_cast<double>(passes);
    }

private:
    using Clock = std::chrono::steady_clock;
    double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

    std::optional<double> seconds_;
    Clock::time_point start_ = Clock::now();
    double before_ = 0;
};

} // namespace argand
