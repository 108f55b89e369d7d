#pragma once

#include "methods/estimation_strategy.hpp"

#include <memory>
#include <vector>

namespace argand {

/// Density over discs of one radius. Caustics have a radius of their own. For
/// make_photon_mapping().
std::unique_ptr<EstimationStrategy> make_fixed_radius();

/// Its options: kernel, support, those of search_options().
std::vector<Option> fixed_radius_options();

} // namespace argand
