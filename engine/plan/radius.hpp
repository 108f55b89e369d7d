#pragma once

#include <cstdint>

namespace argand {

/// Radius of density estimation for a scene of this surface area, in its units. Bias grows as r², variance falls as
/// 1 / (n r²): the balance lies at r ∝ n^(−1/6) (Silverman 1986, §4.3, in two dimensions).
double default_radius(double surface_area, std::uint64_t photons);

} // namespace argand
