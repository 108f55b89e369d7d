#pragma once

#include "methods/render.hpp"

namespace argand {

/// Who hears of a render, and may end it.
struct Listeners {
    const OnProgress& progress;
    const OnPass& on_pass; ///< may be empty
};

using Method = RenderResult (*)(Device& device, const Scene& scene, const RenderSettings& settings,
                                const Listeners& listeners);

RenderResult render_path(Device& device, const Scene& scene, const RenderSettings& settings,
                         const Listeners& listeners);
RenderResult render_photons(Device& device, const Scene& scene, const RenderSettings& settings,
                            const Listeners& listeners);
RenderResult render_nearest(Device& device, const Scene& scene, const RenderSettings& settings,
                            const Listeners& listeners);
RenderResult render_footprints(Device& device, const Scene& scene, const RenderSettings& settings,
                               const Listeners& listeners);

} // namespace argand
