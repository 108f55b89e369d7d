#include "plan/radius.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace argand {

double default_radius(double surface_area, double photons_stored) {
    // Measured on the Cornell boxes.
    constexpr double reference_photons = 250'000;
    constexpr double photons_in_disc = 110;
    const double n = std::max(photons_stored, 1.0);
    const double in_disc = photons_in_disc * std::pow(n / reference_photons, 2.0 / 3.0);
    return std::sqrt(in_disc * surface_area / (std::numbers::pi * n));
}

std::uint64_t area_samples(double surface_area, double radius) {
    constexpr double samples_in_disc = 40;
    constexpr double most = 1 << 20;
    // Where discs are so small that it would take more, edges hardly matter.
    const double wanted = samples_in_disc * surface_area / (std::numbers::pi * radius * radius);
    return wanted <= most ? static_cast<std::uint64_t>(wanted) : 0;
}

} // namespace argand
