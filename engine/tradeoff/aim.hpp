#pragma once

#include "scene/scene.hpp"
#include "tradeoff/pilot.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace argand {

/// What a user asks for instead of a method and numbers of photons and samples: at least one of the two.
struct Aim {
    std::optional<double> error;        ///< relMSE
    std::optional<double> seconds;      ///< of rendering, pilots included
};

/// What the user has chosen nevertheless.
struct Chosen {
    bool method = false, samples = false, photons = false;
};

/// What is expected of one way to render the picture.
struct Prospect {
    RenderSettings settings;            ///< of one pass
    ErrorModel model;
    double seconds_per_pass = 0;
    double passes = 1;                  ///< to the aim; infinite: it cannot be reached
    double seconds = 0;                 ///< that these take
    double error = 0;                   ///< relMSE then
};

/// Whether the error is expected to be met.
bool reaches(const Prospect& prospect, const Aim& aim);

struct AimedRender {
    Aim aim;
    RenderResult result;
    std::vector<Prospect> prospects;    ///< best first, whose settings are the result's; empty: there was no time for pilots
    double pilot_seconds = 0;
    double noise = 0, bias = 0;         ///< parts of the result's relMSE: as measured while it was rendered; as expected
    bool reached = false;               ///< the error that was asked for
};

/// Told what was picked, before it is rendered.
using OnPick = std::function<void(const AimedRender&)>;

/// True if paths from the eye cannot find some light that photons find: of lights without extent, by mirrors or glass.
bool is_blind_to_caustics(const Scene& scene);

/// Renders with the method and the numbers that reach the aim soonest, or come nearest to the truth in the time: told from
/// short pilots of this scene on this device. An error is met when noise that is measured and bias that is expected come to
/// it. Error if no method is expected to reach it within `most_seconds`.
AimedRender render_aimed(const RenderPasses& render, const Scene& scene, const RenderSettings& base, const Chosen& chosen,
                         const Aim& aim, const OnPick& on_pick);

/// Time that is spent on an error if no other is asked for.
inline constexpr double most_seconds = 3600;

/// For users: what was picked and why, and what became of it.
std::string describe_pick(const AimedRender& render);
std::string describe_outcome(const AimedRender& render);

} // namespace argand
