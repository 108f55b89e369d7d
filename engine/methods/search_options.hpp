#pragma once

#include "methods/option.hpp"

#include <optional>

namespace argand {

/// Options of methods that can answer queries of the photon map together: query, query-leaf,
/// partition-cost, frontier-memory.
std::vector<Option> search_options();

/// How a map answers queries together; none if each finds its photons through a tree.
std::optional<FrontierSettings> frontier_of(const RenderSettings& settings);

} // namespace argand
