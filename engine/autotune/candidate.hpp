#pragma once

#include "autotune/pilot.hpp"

#include <optional>

namespace argand {

/// What a user gives instead of a method and numbers of photons and samples: an error, a time, or
/// both. At least one of them is set.
struct Target {
    std::optional<double> error;             ///< relMSE
    std::optional<double> seconds;           ///< time budget of the render, pilots included
    MethodTable methods = builtin_methods(); ///< to choose from
};

/// A way to render the picture, and what it is expected to cost and to achieve.
struct Candidate {
    RenderSettings settings; ///< of one pass
    ErrorModel model;
    double seconds_per_pass = 0;
    double passes = 1;  ///< until the target is met; infinite: it cannot be reached
    double seconds = 0; ///< of these passes, without those that the pilot has made already
    double error = 0;   ///< relMSE after these passes; infinite: its pilot was too short to tell
    bool continues_pilot = false; ///< the picture includes the passes of the pilot
};

/// The candidate with a pilot's settings. It renders until the target error is reached, or as many
/// passes as fit into the time budget after `spent` seconds of it are over.
Candidate candidate_for(const Pilot& pilot, const ErrorModel& model, const Target& target,
                        double spent, bool continues_pilot);

/// Whether the candidate is expected to reach the target error.
bool reaches(const Candidate& candidate, const Target& target);

/// Whether `a` is better than `b`. A candidate that reaches the target error beats one that does
/// not. Of two that reach it, the faster is better; of two that do not, the one of smaller error.
bool is_better(const Candidate& a, const Candidate& b, const Target& target);

} // namespace argand
