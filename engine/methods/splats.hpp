#pragma once

#include "methods/estimation_strategy.hpp"
#include "methods/option.hpp"

#include <memory>
#include <vector>

namespace argand {

/// Density over splats of photons, discs whose size follows from the photon's last ray (Yao et al.
/// 2010, section 6). For make_photon_mapping(). Throws UsageError for options that contradict each
/// other.
std::unique_ptr<EstimationStrategy> make_splats(const RenderContext& context);

/// splat-size, least-density, most-density.
std::vector<Option> splat_options();

} // namespace argand
