#pragma once

#include "autotune/course.hpp"
#include "autotune/exploration.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace argand {

struct AimedRender {
    Aim aim;
    RenderResult result;     ///< if pilots were interrupted, of one of them
    RenderSettings settings; ///< of one pass of the result
    std::vector<Prospect>
        prospects; ///< best first, which the result follows; empty: pilots were interrupted
    double pilot_seconds = 0;
    std::optional<Measured> measured; ///< of the result; nothing: it has too few passes
    bool reached = false;             ///< the error that was asked for
};

/// Told what was picked, before it is rendered.
using OnPick = std::function<void(const AimedRender&)>;

/// True if paths from the eye cannot find some light that photons find: of lights without extent,
/// by mirrors or glass.
bool is_blind_to_caustics(const Scene& scene);

/// Renders with the method and the numbers that reach the aim soonest, or come nearest to the truth
/// in the time: told from short pilots of this scene on this device. An error is met when noise
/// that is measured and bias that is expected come to it. Error if no method is expected to reach
/// it within `most_seconds`.
AimedRender render_aimed(const RenderPasses& render, const Scene& scene, const RenderSettings& base,
                         const Chosen& chosen, const Aim& aim, const OnPick& on_pick);

/// For users: what was picked and why, and what became of it.
std::string describe_pick(const AimedRender& render);
std::string describe_outcome(const AimedRender& render);

} // namespace argand
