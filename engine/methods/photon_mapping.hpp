#pragma once

#include "methods/density_estimator.hpp"

#include <memory>

namespace argand {

/// Photon mapping (Jensen 1996): photons from every light, a map of those that were scattered at
/// least once, density estimation where eye rays meet estimated lobes, direct light by shadow rays.
/// Each pass has its own photons and its own eye paths, so that memory is bounded.
std::unique_ptr<Method> make_photon_mapping(RenderContext& context,
                                            std::unique_ptr<DensityEstimator> estimator);

/// Bandwidths of all photon-mapping methods shrink as n^(-1/6) with the number of passes n
/// (photon/radius.hpp), so areas shrink as n^(-1/3). The noise of density estimation grows with one
/// over the area. Squared bias falls as n^(-2/3) on smooth surfaces, where it goes with the area,
/// and as n^(-1/6) along edges, in bands as wide as the bandwidth; together about as n^(-1/3), as
/// measured (docs/results/targets.md).
inline constexpr ErrorLaw photon_mapping_law{.noise_growth = 1.0 / 3, .bias_fall = 1.0 / 3};

} // namespace argand
