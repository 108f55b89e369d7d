#pragma once

#include "autotune/exploration.hpp"
#include "autotune/run_control.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace argand {

/// A render whose method and numbers of photons and samples Argand picked.
struct AutotunedRender {
    Target target;
    /// If the user interrupted it or it was given up (RunOutcome::too_long), the picture that is
    /// known to have the least error, which may be a pilot's.
    RenderResult result;
    RenderSettings settings; ///< of one pass of the result
    /// Best first; the final render uses the first. Empty if the pilots were interrupted.
    std::vector<Candidate> candidates;
    double pilot_seconds = 0;
    std::optional<MeasuredError> measured; ///< of the result; none: it has too few passes
    RunOutcome outcome = RunOutcome::unfinished;
    std::string witness; ///< the method that judged the result's bias; empty: none was needed
    std::string witness_of_caustics; ///< the method whose narrow passes judged these; or empty
    double witness_seconds = 0;      ///< of both

    /// Whether the result has the target error, as far as a witness can tell.
    bool reached() const { return outcome == RunOutcome::reached; }
};

/// Called with the pick before it is rendered: result and settings are not set yet.
using OnPick = std::function<void(const AutotunedRender&)>;

/// Renders with the method and the numbers of photons and samples that reach the target error
/// soonest, or have the least error within the time budget. Chooses from short pilots of this scene
/// on this device. A render reaches an error when its measured noise plus its expected squared bias
/// is no larger, and a witness confirms it: pictures by the unbiased method, and passes with narrow
/// bandwidths for caustics, or for all light where that method is blind. If a witness finds more
/// bias than expected, or the render takes far more passes than expected, and the unbiased method
/// is faster for that, the render starts again with it. Throws Error if no method is expected to
/// reach the error within `default_time_limit` and the target has no budget.
AutotunedRender autotune(const RenderPasses& render, const Scene& scene, const RenderSettings& base,
                         const UserSet& user_set, const Target& target, const OnPick& on_pick);

/// One line for users: what was picked and why.
std::string describe_pick(const AutotunedRender& render);
/// One line for users: the error of the result, and whether it reached its target.
std::string describe_outcome(const AutotunedRender& render);

} // namespace argand
