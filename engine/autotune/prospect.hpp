#pragma once

#include "autotune/pilot.hpp"

#include <optional>

namespace argand {

/// What a user asks for instead of a method and numbers of photons and samples: at least one of the
/// two.
struct Aim {
    std::optional<double> error;             ///< relMSE
    std::optional<double> seconds;           ///< of rendering, pilots included
    MethodTable methods = builtin_methods(); ///< to choose from
};

/// What is expected of one way to render the picture.
struct Prospect {
    RenderSettings settings; ///< of one pass
    ErrorModel model;
    double seconds_per_pass = 0;
    double passes = 1;    ///< to the aim; infinite: it cannot be reached
    double seconds = 0;   ///< that these take, but for those which the pilot has made
    double error = 0;     ///< relMSE then; infinite: its pilot was too short to tell
    bool goes_on = false; ///< the pilot's own passes are part of the picture
};

/// Of a pilot's settings: to the error, or in what is left of the time after so many seconds.
Prospect prospect_of(const Pilot& pilot, const ErrorModel& model, const Aim& aim, double spent,
                     bool goes_on);

/// Whether the error is expected to be met.
bool reaches(const Prospect& prospect, const Aim& aim);

/// Which of two is better: the one that reaches the error, then the sooner; of those that do not,
/// the one with less.
bool is_better(const Prospect& a, const Prospect& b, const Aim& aim);

} // namespace argand
