#pragma once

#include "methods/estimation_strategy.hpp"
#include "methods/tracing_strategy.hpp"

#include <memory>

namespace argand {

/// Photon mapping (Jensen 1996): photons from every light, a map of those that were scattered at
/// least once, density estimation where eye rays meet estimated lobes, direct light by shadow rays.
/// Each pass has its own photons and its own eye paths, so that memory is bounded. progressive:
/// widths fall from pass to pass, whatever the settings say. tracing: how photons find their hits;
/// null: through the scene's tree.
std::unique_ptr<Method> make_photon_mapping(RenderContext& context,
                                            std::unique_ptr<EstimationStrategy> strategy,
                                            bool progressive = false,
                                            std::unique_ptr<TracingStrategy> tracing = nullptr);

} // namespace argand
