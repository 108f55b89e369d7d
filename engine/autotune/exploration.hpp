#pragma once

#include "autotune/pilots.hpp"

#include <optional>
#include <string>

namespace argand {

/// Which settings the user has given. Autotuning keeps them.
struct UserSet {
    bool method = false, samples = false, photons = false;
};

/// Decides which pilots to run, one after the other.
struct Exploration {
    const Pilots& pilots; ///< so far
    const RenderSettings& base;
    const UserSet& user_set;
    const Target& target;
    bool eye_paths_find_all; ///< whether paths from the eye find all light

    /// Settings of the next pilot. Nothing if no further pilot is worth its time.
    std::optional<RenderSettings> next_pilot() const;

    /// Settings of a short pass of the unbiased method, whatever samples the user has set.
    RenderSettings short_pass(const MethodInfo& unbiased) const;

    /// Seconds after which the next pilot may end early.
    double pilot_time_limit() const;

private:
    RenderSettings of_method(const std::string& method) const;
    std::string first_method() const;
    bool is_worth_trying(const MethodInfo& method) const;
    bool has_time(double share) const;
};

} // namespace argand
