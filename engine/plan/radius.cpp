#include "plan/radius.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace argand {

double default_radius(double surface_area, std::uint64_t photons) {
    // Measured on the Cornell boxes: 110 photons in a disc where 200,000 photons were emitted.
    constexpr double reference_photons = 200'000;
    constexpr double photons_in_disc = 110;
    const double n = std::max(static_cast<double>(photons), 1.0);
    const double in_disc = photons_in_disc * std::pow(n / reference_photons, 2.0 / 3.0);
    return std::sqrt(in_disc * surface_area / (std::numbers::pi * n));
}

} // namespace argand
