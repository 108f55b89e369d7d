#pragma once

#include "methods/render.hpp"

namespace argand {

/// Two pictures of the same, by path tracing, whose noise is independent.
struct References {
    RenderResult a, b;
};

References trace_references(Device& device, const Scene& scene, RenderSettings settings,
                            std::uint32_t samples);

/// relMSE of a layer, without the references' noise (image/metrics.hpp).
double rel_mse(const RenderResult& result, const References& references, const std::string& layer);

/// To the end.
RenderResult render_all(Device& device, const Scene& scene, const RenderSettings& settings);

} // namespace argand
