#pragma once

#include "photon/estimator.hpp"
#include "photon/frontier_settings.hpp"
#include "shared/frontier_records.h"

#include <functional>

namespace argand {

/// Leaves of one level: queries that lie side by side, and the photons that may count at them.
struct FrontierLeaves {
    Buffer places;           ///< uvec4 per query: its position and its slot
    Buffer segments;         ///< uint per query: its node, or no_segment
    Buffer nodes;            ///< FrontierNode; those that are frontier_leaf count
    Buffer references;       ///< uvec4 per reference: position and index of a photon
    std::uint32_t first = 0; ///< queries
    std::uint32_t end = 0;
    std::uint32_t most_photons = 0; ///< of a leaf
};

/// What a search did.
struct FrontierStatistics {
    std::uint64_t levels = 0;     ///< or parts of levels, where some wait
    std::uint64_t photons = 0;    ///< of the map
    std::uint64_t entered = 0;    ///< photons in the box of all queries' balls
    std::uint64_t box_tests = 0;  ///< of photons
    std::uint64_t references = 0; ///< divided, on all levels
    std::uint64_t discarded = 0;  ///< references that went to no child
    std::uint64_t replicated =
        0; ///< copies beyond one, of references that went to several children
    std::uint64_t leaves = 0;
    std::uint64_t pairs = 0; ///< compared in leaves
    std::uint64_t waits = 0; ///< parts of a level that waited for room
};

/// Searches for all photons near all queries at once: Keller et al. 2010, algorithm 1, breadth
/// first. The photons of a node are those in the box of its queries' balls. A node of few queries
/// is a leaf, any other is partitioned in the middle of the longest axis of its queries' box. Up to
/// three partitions of queries make the children among which photons are divided.
/// Clears the sums of the queries (`suspended`), then calls `add` with the leaves of each level in
/// turn, until each pair of a query and a photon within its reach has been in exactly one leaf.
/// `add` only records. reach: distance within which photons count; of a map with footprints these
/// decide instead. Waits for the device. Throws Error if settings.memory is less than
/// least_frontier_memory. statistics: added to if not null, which takes time. Returns the number of
/// queries.
std::uint32_t search_simultaneously(Device& device, const PhotonMap& map,
                                    const PhotonQueries& queries, double reach,
                                    const FrontierSettings& settings,
                                    const std::function<void(const FrontierLeaves&)>& add,
                                    FrontierStatistics* statistics = nullptr);

} // namespace argand
