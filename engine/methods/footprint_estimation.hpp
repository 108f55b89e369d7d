#pragma once

#include "methods/estimation_strategy.hpp"

#include <memory>
#include <vector>

namespace argand {

/// Density over each photon's own footprint (Fabianowski and Dingliana 2009). For
/// make_photon_mapping().
std::unique_ptr<EstimationStrategy> make_footprints();

/// Its options.
std::vector<Option> footprint_options();

} // namespace argand
