#pragma once

#include "base/archive.hpp"
#include "base/clock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace argand {

/// Decides how many passes a render has: a fixed number, or as many as fit in a time.
class Budget {
public:
    /// seconds: the time, from now on; none: every pass once.
    explicit Budget(std::optional<double> seconds) : seconds_(seconds) {}

    /// Call where the first pass begins. Work before it tells nothing of how long passes take.
    void start_pass() { begun_ = elapsed(); }

    /// Runs work that only the first pass has, and leaves it out of the time of that pass.
    template <typename Work> auto once(const Work& work) {
        const double before = elapsed();
        auto result = work();
        begun_ += elapsed() - before;
        return result;
    }

    /// Call after each pass, where the next one begins. Returns whether there is another one: with
    /// a time, whether it fits if it takes as long as the last one.
    bool another(std::uint64_t done, std::uint64_t passes) {
        if (!seconds_) {
            return done < passes;
        }
        const double now = elapsed();
        if (done != counted_) {
            last_ = now - begun_;
            in_passes_ += last_;
            counted_ = done;
        }
        begun_ = now;
        return now + last_ <= *seconds_;
    }

    /// The expected number of passes of the whole render, after `done` of them.
    double expected(std::uint64_t done, std::uint64_t passes) const {
        if (!seconds_ || done == 0) {
            return static_cast<double>(passes);
        }
        const double each = std::max(in_passes_ / static_cast<double>(done), 1e-9);
        return std::round(static_cast<double>(done) + std::max(*seconds_ - elapsed(), 0.0) / each);
    }

    /// The share of the work that is done, after `done` passes and `part` of the current one.
    double share(std::uint64_t done, double part, std::uint64_t passes) const {
        return seconds_ ? std::min(elapsed() / *seconds_, 1.0)
                        : (static_cast<double>(done) + part) / static_cast<double>(passes);
    }

    /// Saves or loads the time spent so far.
    void persist(Archive& archive) {
        constexpr double most = 1e9;
        double spent = elapsed();
        archive.value(spent);
        archive.value(in_passes_);
        archive.value(last_);
        archive.value(counted_);
        if (archive.loads()) {
            if (!(spent >= 0 && spent <= most)) {
                fail("loading a saved state: it has taken {} s", spent);
            }
            begun_ = spent;
            start_ = Clock::now() - std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(spent));
        }
    }

private:
    double elapsed() const { return seconds_since(start_); }

    std::optional<double> seconds_;
    Clock::time_point start_ = Clock::now();
    double begun_ = 0, in_passes_ = 0;
    double last_ = 0;           ///< seconds of the last pass
    std::uint64_t counted_ = 0; ///< passes in in_passes_
};

} // namespace argand
