#pragma once

#include "base/on_progress.hpp"
#include "session/session.hpp"

#include <functional>

namespace argand {

/// An image to which passes may be added.
struct PictureSoFar {
    std::uint64_t passes = 0;                   ///< whose mean it is; 0: it is still black
    std::function<std::vector<Layer>()> layers; ///< as in RenderResult; waits for the device
};

/// Called before the first pass and after each pass for the next one; none: no more.
using OnPass = std::function<std::optional<PassPlan>(const PictureSoFar&)>;

/// Adds passes to the image of a session that has begun one, until the budget, the settings'
/// photons and samples, on_pass or on_progress end it.
RenderResult finish(Session& session, const OnProgress& on_progress,
                    const OnPass& on_pass = nullptr);

/// Renders the scene that `world` holds. With `on_pass` the settings' samples and photons are those
/// of one pass, and on_pass decides how many passes there are, not the budget. Throws UsageError on
/// an unknown method, Error if the device cannot do it.
RenderResult render(World& world, const Scene& scene, const RenderSettings& settings,
                    const OnProgress& on_progress, const OnPass& on_pass = nullptr,
                    MethodTable methods = builtin_methods());

/// As above, in a world of its own.
RenderResult render(Device& device, const Scene& scene, const RenderSettings& settings,
                    const OnProgress& on_progress, const OnPass& on_pass = nullptr,
                    MethodTable methods = builtin_methods());

} // namespace argand
