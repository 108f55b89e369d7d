#pragma once

#include "shared/photon_records.h"

#include <cstdint>
#include <span>

namespace argand {

/// Photons that a disc of density estimation should hold where so many are stored in all. Bias grows as r², variance
/// falls as 1 / (n r²): the balance lies at r ∝ n^(−1/6) (Silverman 1986, §4.3, in two dimensions).
double photons_in_disc(double photons_stored);

/// Radius within which half of the photons have `in_disc` or more others, in the scene's units: the median over a
/// sample of photons of the distance to the last of the nearest, looked for among those near it in the order of the
/// Morton codes. It follows the surfaces that light reaches, whatever else is in the scene. 0 without photons.
double median_radius(std::span<const PhotonRecord> in_morton_order, double in_disc);

/// Number of samples of a surface of this area that tell a disc of this radius anywhere on it how much of it is
/// covered; 0 if the disc is too small for that.
std::uint64_t area_samples(double surface_area, double radius);

} // namespace argand
