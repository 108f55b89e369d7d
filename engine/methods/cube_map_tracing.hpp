#pragma once

#include "methods/option.hpp"
#include "methods/tracing_strategy.hpp"

#include <memory>
#include <vector>

namespace argand {

/// Photons find their hits in cube maps around centers (Yao et al. 2010), which are chosen anew for
/// each image: so an image does not depend on those before it.
std::unique_ptr<TracingStrategy> make_cube_map_tracing();

/// maps-count, map-size, coverage, maps, steps, march, map-hits, map-error.
std::vector<Option> cube_map_options();

} // namespace argand
