#pragma once

#include "photon/estimator.hpp"

#include <type_traits>

namespace argand {

/// What every gather passes to its kernel; the caller adds the parameters of its estimator.
inline PhotonGatherParams gather_params(const PhotonMap& map, const PhotonQueries& queries,
                                        std::uint32_t budget) {
    return {.budget = budget,
            .count_index = queries.count.index,
            .boundary_correction = map.area_samples > 0 ? 1u : 0u,
            .part = queries.part};
}

/// Calls `use` with std::type_identity of the kernel that reads the map from storage buffers, or of
/// the one that reads it as texels where that is faster.
template <class Storage, class Texels, class Use>
void with_map_kernel(const Device& device, const PhotonMap& map, const Use& use) {
    if (read_as_texels(device, map.lbvh.nodes, map.photons)) {
        use(std::type_identity<Texels>());
    } else {
        use(std::type_identity<Storage>());
    }
}

/// Calls `run(params, unfinished)` once, or until it leaves no query unfinished.
template <class Run>
void run_queries(Device& device, const PhotonQueries& queries, PhotonGatherParams params,
                 const Run& run) {
    params.first = 1;
    if (!queries.until_complete) {
        run(params, queries.unfinished);
        return;
    }
    const Buffer unfinished = device.allocate("unfinished queries", 4);
    do {
        device.fill(unfinished, 0);
        run(params, unfinished);
        params.first = 0;
    } while (download<std::uint32_t>(device, unfinished, 1)[0] > 0);
}

} // namespace argand
