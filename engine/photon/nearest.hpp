#pragma once

#include "photon/gather.hpp"

namespace argand {

struct NearestSettings {
    std::uint32_t neighbours = 0; ///< k, at least 1
    double radius = 0;            ///< r_max, in the scene's units
    double samples_per_area = 0;  ///< area samples of the map over the area that they are of
};

/// Working memory of careful queries: NearestRecord (shared/nearest_records.h) of those answered
/// last, at most nearest_places of them. What is left in them when they are done tells the k-th
/// nearest photon.
inline constexpr const char* nearest_states = "nearest photons: states";
inline constexpr std::uint64_t nearest_places = 1u << 14;

/// As gather_photons, over the k nearest photons within r_max (Jensen 1996) that lie on the query's
/// surface: those whose normal does not differ, by the distance |d|² + 99 (d·n)², so that what is
/// near is a disc and not a ball. The k-th one's distance is the radius of the kernel; if there are
/// fewer than k, r_max is. Exact, ties by the order of the map.
void gather_nearest(Device& device, const DeviceScene& scene, const PhotonMap& map,
                    const GatherTarget& target, Traversal& traversal,
                    const NearestSettings& settings, const Count& asking,
                    std::uint32_t budget = gather_budget);

} // namespace argand
