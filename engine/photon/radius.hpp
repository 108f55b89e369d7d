#pragma once

#include "shared/photon_records.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace argand {

/// Photons that a disc of density estimation should hold where so many are stored in all. Bias
/// grows as r², variance falls as 1 / (n r²): the balance lies at r ∝ n^(−1/6) (Silverman 1986,
/// §4.3, in two dimensions). Caustics, which have edges, want fewer.
double photons_in_disc(double photons_stored, bool caustic = false);

/// Radius within which half of the points have `in_disc` or more photons, in the scene's units: the
/// median of the distance to the last of the nearest, looked for among the photons that are near in
/// the order of the Morton codes, in which they come. `low`, `high`: the box of the codes. 0
/// without photons or points.
double median_radius(std::span<const PhotonRecord> photons, std::span<const glm::vec3> points,
                     glm::vec3 low, glm::vec3 high, double in_disc);

/// Number of samples of a surface of this area that tell a disc of this radius anywhere on it how
/// much of it is covered; 0 if the disc is too small for that.
std::uint64_t area_samples(double surface_area, double radius);

} // namespace argand
