#pragma once

#include "autotune/pilots.hpp"

#include <optional>
#include <string>

namespace argand {

/// What the user has chosen nevertheless.
struct Chosen {
    bool method = false, samples = false, photons = false;
};

/// Which pilots there are to be, one after the other.
struct Exploration {
    const Pilots& pilots; ///< so far
    const RenderSettings& base;
    const Chosen& chosen;
    const Aim& aim;
    bool path_is_true; ///< paths from the eye find all light

    /// Nothing: no other is worth its time.
    std::optional<RenderSettings> next() const;

    /// After which the next one may end early.
    double most_seconds() const;

private:
    RenderSettings of_method(const std::string& method) const;
    std::string first_method() const;
    bool is_worth(const MethodInfo& method) const;
    bool has_time(double share) const;
};

} // namespace argand
