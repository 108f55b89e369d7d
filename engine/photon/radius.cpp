#include "photon/radius.hpp"

#include "base/median.hpp"
#include "kernels/photon_distances.hpp"
#include "shared/photon.h"

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

namespace {

// Rank, among the photons looked at, of the distance that is measured: enough for an error of 9 %
// at one point, and of less than 1 % in the median of all points.
constexpr double enough_rank = 32;
// Photons looked at on either side of a point's place in the order, over those that a disc holds.
constexpr double reach_over_disc = 4;

/// The median distance to the `in_disc`-th nearest photon. caustic_step: as in
/// PhotonDistanceParams.
double median_distance(Device& device, const SortedPhotons& sorted, const Buffer& points,
                       std::size_t count, double in_disc, std::uint32_t caustic_step) {
    const StageScope stage(device, "learn bandwidth");
    // A point may be that of a photon, which is not its own neighbour.
    const double others = caustic_step > 0 ? 0 : sorted.others;
    const double rank = std::min(in_disc, others + sorted.caustics - 1) + 1;
    const double stride = std::max(std::floor(rank / enough_rank), 1.0);
    const Buffer distances = device.scratch("learnt distances", count * sizeof(float));
    dispatch(device,
             kernels::photon_distances{
                 .photons = sorted.photons,
                 .codes = sorted.codes,
                 .bounds = sorted.bounds,
                 .points = points,
                 .distances = distances,
                 .params = {.points = static_cast<std::uint32_t>(count),
                            .rank = rank_among_every(stride, rank),
                            .reach = static_cast<std::uint32_t>(reach_over_disc * rank),
                            .stride = static_cast<std::uint32_t>(stride),
                            .others = sorted.others,
                            .caustics = sorted.caustics,
                            .caustic_step = caustic_step}},
             count);
    const std::vector<float> found = download<float>(device, distances, count);
    return median({found.begin(), found.end()});
}

} // namespace

double median_radius(Device& device, const SortedPhotons& sorted, std::span<const glm::vec4> points,
                     double in_disc) {
    if (sorted.others + sorted.caustics == 0 || points.empty()) {
        return 0;
    }
    return median_distance(device, sorted, upload(device, "learning points", points), points.size(),
                           in_disc, 0);
}

double median_caustic_radius(Device& device, const SortedPhotons& sorted, double in_disc) {
    if (sorted.caustics == 0) {
        return 0;
    }
    constexpr std::uint32_t points = 1024;
    const std::uint32_t step = std::max(sorted.caustics / points, 1u);
    return median_distance(device, sorted, sorted.bounds, (sorted.caustics + step - 1) / step,
                           in_disc, step);
}

namespace {

constexpr double most_area_samples = 1 << 20;

double wanted_area_samples(double surface_area, double radius) {
    constexpr double samples_in_disc = 90;
    return samples_in_disc * surface_area / (std::numbers::pi * radius * radius);
}

} // namespace

bool has_room_for_area_samples(double surface_area, double radius, double share) {
    return share * wanted_area_samples(surface_area, radius) <= most_area_samples;
}

std::uint64_t area_samples(double surface_area, double radius, double share) {
    const double wanted = wanted_area_samples(surface_area, radius);
    return least_area_share * wanted <= most_area_samples
               ? static_cast<std::uint64_t>(std::min(share * wanted, most_area_samples))
               : 0;
}

} // namespace argand
