#pragma once

#include "methods/estimation_strategy.hpp"

#include <memory>
#include <vector>

namespace argand {

/// Density over the disc that the k nearest photons fill. For make_photon_mapping().
std::unique_ptr<EstimationStrategy> make_nearest();

/// Its options: k, caustic-k.
std::vector<Option> nearest_options();

} // namespace argand
