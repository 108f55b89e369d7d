#pragma once

#include "kernels/frontier_bindings.hpp"
#include "photon/frontier.hpp"
#include "photon/gather.hpp"
#include "photon/gather_dispatch.hpp"

#include <algorithm>

namespace argand {

/// What an estimator says of its answers.
struct Answering {
    double reach = 0;                     ///< distance within which photons count
    std::uint32_t area_samples = 0;       ///< that correct estimates
    bool caustic_correction = true;       ///< whether they correct caustics, too
    std::uint32_t budget = gather_budget; ///< photons that a dispatch adds to a query at most
};

/// Specialization constants for the member `frontier` of a leaf kernel's constants.
inline kernels::FrontierConstants frontier_constants(const Plan& plan,
                                                     const PhotonQueries& queries) {
    return {.glossy = plan.needs(Feature::glossy_estimates),
            .limits_scatterings = queries.limits_scatterings,
            .caustics = plan.needs(Feature::caustics)};
}

/// Turns the sums of `count` queries into their answers.
void store_answers(Device& device, const PhotonMap& map, const PhotonQueries& queries,
                   std::uint32_t count, const Answering& how);

/// Answers all queries at once. Calls run.operator()<Kernel>(params, bindings, threads) for the
/// leaves of each level, as often as their photons require: Kernel adds them to the sums, and reads
/// the map from storage buffers, or as texels where that is faster.
template <class Storage, class Texels, class Run>
void answer_simultaneously(Device& device, const PhotonMap& map, const PhotonQueries& queries,
                           const Answering& how, const Run& run) {
    const auto add = [&](const FrontierLeaves& leaves) {
        const kernels::FrontierBindings bindings{.photons = map.photons,
                                                 .queries = queries.points,
                                                 .query_bsdfs = queries.bsdfs,
                                                 .gathers = queries.suspended,
                                                 .places = leaves.places,
                                                 .segments = leaves.segments,
                                                 .frontier = leaves.nodes,
                                                 .references = leaves.references};
        for (std::uint32_t first = 0; first < leaves.most_photons; first += how.budget) {
            const FrontierGatherParams params{.first = leaves.first,
                                              .end = leaves.end,
                                              .first_photon = first,
                                              .photons = how.budget};
            const std::uint64_t threads = leaves.end - leaves.first;
            if (read_as_texels(device, map.photons, leaves.references)) {
                run.template operator()<Texels>(params, bindings, threads);
            } else {
                run.template operator()<Storage>(params, bindings, threads);
            }
        }
    };
    const std::uint32_t count =
        search_simultaneously(device, map, queries, how.reach, *map.frontier, add);
    store_answers(device, map, queries, count, how);
}

} // namespace argand
