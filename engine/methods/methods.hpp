#pragma once

#include "methods/render.hpp"

namespace argand {

using Method = RenderResult (*)(Device& device, const Scene& scene, const RenderSettings& settings,
                                const OnProgress& progress);

RenderResult render_path(Device& device, const Scene& scene, const RenderSettings& settings, const OnProgress& progress);
RenderResult render_photons(Device& device, const Scene& scene, const RenderSettings& settings,
                            const OnProgress& progress);
RenderResult render_nearest(Device& device, const Scene& scene, const RenderSettings& settings,
                            const OnProgress& progress);
RenderResult render_footprints(Device& device, const Scene& scene, const RenderSettings& settings,
                               const OnProgress& progress);

} // namespace argand
