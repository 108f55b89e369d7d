#pragma once

#include "kernels/query_bindings.hpp"
#include "photon/estimator.hpp"

namespace argand {

/// What every gather passes to its kernel; the caller adds the parameters of its estimator.
inline PhotonGatherParams gather_params(const PhotonMap& map, const PhotonQueries& queries,
                                        std::uint32_t budget) {
    PhotonGatherParams params{.budget = budget,
                              .count_index = queries.count.index,
                              .boundary_correction = map.area_samples > 0 ? 1u : 0u,
                              .part = queries.part};
    set_corrected_part(params, map.corrected);
    return params;
}

/// Buffers for the member `query` of a gather's kernel.
inline kernels::QueryBindings query_bindings(const PhotonMap& map, const PhotonQueries& queries,
                                             const Buffer& unfinished) {
    return {.nodes = map.lbvh.nodes,
            .photons = map.photons,
            .counters = map.counters,
            .active_slots = queries.slots,
            .counts = queries.count.buffer,
            .queries = queries.points,
            .query_bsdfs = queries.bsdfs,
            .unfinished = unfinished,
            .estimates = queries.estimates};
}

/// Specialization constants for the member `query` of its constants.
inline kernels::QueryConstants query_constants(const Plan& plan, const PhotonQueries& queries) {
    return {.glossy = plan.needs(Feature::glossy_estimates),
            .limits_scatterings = queries.limits_scatterings,
            .caustics = plan.needs(Feature::caustics)};
}

/// Calls `run(params, bindings)` once, or until it leaves no query unfinished.
template <class Run>
void run_queries(Device& device, const PhotonMap& map, const PhotonQueries& queries,
                 PhotonGatherParams params, const Run& run) {
    params.first = 1;
    if (!queries.until_complete) {
        run(params, query_bindings(map, queries, queries.unfinished));
        return;
    }
    const Buffer unfinished = device.allocate("unfinished queries", 4);
    do {
        device.fill(unfinished, 0);
        run(params, query_bindings(map, queries, unfinished));
        params.first = 0;
    } while (download_word(device, unfinished) > 0);
}

/// The same with run.operator()<Kernel>(params, bindings): Kernel reads the map from storage
/// buffers, or as texels where that is faster.
template <class Storage, class Texels, class Run>
void gather(Device& device, const PhotonMap& map, const PhotonQueries& queries,
            const PhotonGatherParams& params, const Run& run) {
    run_queries(device, map, queries, params,
                [&](const PhotonGatherParams& now, const kernels::QueryBindings& bindings) {
                    if (read_as_texels(device, map.lbvh.nodes, map.photons)) {
                        run.template operator()<Texels>(now, bindings);
                    } else {
                        run.template operator()<Storage>(now, bindings);
                    }
                });
}

} // namespace argand
