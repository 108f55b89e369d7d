#pragma once

#include <cstdint>

namespace argand {

/// Radius of density estimation where so many photons are stored on surfaces of this area, in the scene's units. Bias
/// grows as r², variance falls as 1 / (n r²): the balance lies at r ∝ n^(−1/6) (Silverman 1986, §4.3, in two
/// dimensions).
double default_radius(double surface_area, double photons_stored);

/// Number of samples of a surface of this area that tell a disc of this radius anywhere on it how much of it is covered; 0 if the disc
/// is too small for that.
std::uint64_t area_samples(double surface_area, double radius);

} // namespace argand
