#pragma once

#include "shared/photon_records.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace argand {

/// Photons that a disc of density estimation should hold if `photons_stored` are stored in all.
/// Bias grows as r², variance falls as 1 / (n r²): their balance is r ∝ n^(−1/6) (Silverman 1986,
/// §4.3, in two dimensions). Caustics have edges, and are better with fewer photons.
double photons_in_disc(double photons_stored, bool caustic = false);

/// Radius within which half of the points have `in_disc` or more photons, in the scene's units: the
/// median distance to the `in_disc`-th nearest photon. photons: sorted by their Morton codes in the
/// box from `low` to `high`; only those near in this order are looked at. 0 without photons or
/// points.
double median_radius(std::span<const PhotonRecord> photons, std::span<const glm::vec3> points,
                     glm::vec3 low, glm::vec3 high, double in_disc);

/// Whether a map has room for the samples of surfaces of this area that discs of this radius want.
bool has_room_for_area_samples(double surface_area, double radius);

/// Number of samples of surfaces of this area from which to estimate how much of a disc of this
/// radius lies on them: 90 in a disc, or down to a quarter of that if a map has no room for more; 0
/// if it has no room for these.
std::uint64_t area_samples(double surface_area, double radius);

} // namespace argand
