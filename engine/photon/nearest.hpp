#pragma once

#include "photon/gather.hpp"

namespace argand {

struct NearestSettings {
    std::uint32_t neighbours = 0; ///< k, at least 1
    double radius = 0;            ///< r_max, in the scene's units
    double samples_per_area = 0;  ///< the map's area samples over the area of the surfaces
    /// k and r_max of queries of the caustic part alone (Jensen's caustic map); k 0: as above.
    std::uint32_t caustic_neighbours = 0;
    double caustic_radius = 0;
};

/// Queries whose states fit into memory at once; with `until_complete` more queries are answered in
/// groups of this size.
inline constexpr std::uint64_t nearest_places = 1u << 14;

/// Density estimation over the k nearest photons within r_max (Jensen 1996) that lie on the query's
/// surface, which photons of a similar normal do. Distances are |d|² + 99 (d·n)², so that
/// neighbourhoods are discs and not balls. The kernel's radius is the distance of the k-th photon,
/// or r_max if there are fewer than k. Exact; ties go by the order of the map.
class NearestEstimator final : public PhotonEstimator {
public:
    NearestEstimator(Device& device, const Plan& plan, const NearestSettings& settings,
                     std::uint32_t budget = gather_budget)
        : device_(device), plan_(plan), settings_(settings), budget_(budget) {}

    void estimate(const PhotonMap& map, const PhotonQueries& queries) override;

    /// NearestRecord (shared/nearest_records.h) of the queries that were last answered
    /// `until_complete`, at most nearest_places of them: a finished state tells which photon is the
    /// k-th nearest.
    const Buffer& states() const { return states_; }

private:
    Device& device_;
    const Plan& plan_;
    NearestSettings settings_;
    std::uint32_t budget_;
    Buffer states_, words_; ///< of queries between two dispatches; `words_` are their bins
};

} // namespace argand
