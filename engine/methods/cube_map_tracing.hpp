#pragma once

#include "methods/option.hpp"
#include "methods/tracing_strategy.hpp"

#include <memory>
#include <vector>

namespace argand {

/// Photons find their hits in cube maps around centers (Yao et al. 2010). These are chosen anew for
/// each image, which then does not depend on those before it, unless choose-every lets it keep
/// them.
std::unique_ptr<TracingStrategy> make_cube_map_tracing();

/// choose-every, maps-count, map-size, coverage, maps, steps, march, map-hits, map-error.
std::vector<Option> cube_map_options();

} // namespace argand
