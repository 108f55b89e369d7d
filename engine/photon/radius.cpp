#include "photon/radius.hpp"

#include "shared/morton.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace argand {

double photons_in_disc(double photons_stored, bool caustic) {
    // docs/results/bandwidth.md
    constexpr double reference_photons = 200'000;
    const double in_disc = caustic ? 150 : 340;
    return std::max(in_disc * std::pow(photons_stored / reference_photons, 2.0 / 3.0), 4.0);
}

double median_radius(std::span<const PhotonRecord> photons, std::span<const glm::vec3> points,
                     glm::vec3 low, glm::vec3 high, double in_disc) {
    if (photons.empty() || points.empty()) {
        return 0;
    }
    std::vector<std::uint32_t> codes;
    codes.reserve(photons.size());
    for (const PhotonRecord& photon : photons) {
        codes.push_back(morton30({photon.x, photon.y, photon.z}, low, high));
    }
    // Neighbours on a surface are near in the order, but on both sides and with gaps.
    const auto nearest = static_cast<std::size_t>(in_disc);
    const std::size_t reach = 3 * nearest;
    std::vector<double> radii;
    std::vector<double> distances;
    for (const glm::vec3& point : points) {
        const auto place = static_cast<std::size_t>(
            std::lower_bound(codes.begin(), codes.end(), morton30(point, low, high)) -
            codes.begin());
        const std::size_t begin = place > reach ? place - reach : 0;
        const std::size_t end = std::min(place + reach + 1, photons.size());
        distances.clear();
        for (std::size_t j = begin; j < end; ++j) {
            const glm::dvec3 d =
                glm::dvec3(photons[j].x, photons[j].y, photons[j].z) - glm::dvec3(point);
            distances.push_back(glm::dot(d, d));
        }
        const auto last = distances.begin() +
                          static_cast<std::ptrdiff_t>(std::min(nearest, distances.size() - 1));
        std::nth_element(distances.begin(), last, distances.end());
        radii.push_back(std::sqrt(*last));
    }
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    return *middle;
}

namespace {

constexpr double most_area_samples = 1 << 20;

double wanted_area_samples(double surface_area, double radius) {
    constexpr double samples_in_disc = 90;
    return samples_in_disc * surface_area / (std::numbers::pi * radius * radius);
}

} // namespace

bool has_room_for_area_samples(double surface_area, double radius) {
    return wanted_area_samples(surface_area, radius) <= most_area_samples;
}

std::uint64_t area_samples(double surface_area, double radius) {
    constexpr double enough = 0.25; // of the samples
    const double wanted = wanted_area_samples(surface_area, radius);
    return enough * wanted <= most_area_samples
               ? static_cast<std::uint64_t>(std::min(wanted, most_area_samples))
               : 0;
}

} // namespace argand
