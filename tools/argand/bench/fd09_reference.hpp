#pragma once

#include "device/device.hpp"
#include "methods/render_result.hpp"
#include "methods/render_settings.hpp"
#include "scene/scene.hpp"

namespace argand {

/// Two path-traced images of the same view with independent noise.
struct References {
    RenderResult a, b;
};

References trace_references(Device& device, const Scene& scene, RenderSettings settings,
                            std::uint32_t samples);

/// relMSE of a layer, corrected for the references' noise (image/metrics.hpp).
double rel_mse(const RenderResult& result, const References& references, const std::string& layer);

/// Renders to the end.
RenderResult render_all(Device& device, const Scene& scene, const RenderSettings& settings);

} // namespace argand
