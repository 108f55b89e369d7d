#include "photon/nearest.hpp"

#include "kernels/nearest_gather.hpp"
#include "kernels/nearest_gather_texels.hpp"
#include "photon/gather_dispatch.hpp"
#include "shared/nearest_records.h"

#include <algorithm>

namespace argand {

void NearestEstimator::estimate(const PhotonMap& map, const PhotonQueries& queries) {
    const StageScope stage(device_, "gather photons");
    const Count& count = queries.count;
    PhotonGatherParams params = gather_params(map, queries, budget_);
    params.radius = static_cast<float>(settings_.radius);
    params.neighbours = settings_.neighbours;
    params.samples_per_area = static_cast<float>(settings_.samples_per_area);

    std::uint64_t number = 0;
    if (queries.until_complete) {
        number = download<std::uint32_t>(device_, count.buffer, 1, count.index)[0];
        const std::uint64_t places = std::clamp<std::uint64_t>(
            std::min(nearest_places, device_.info().limits.storage_range / (nearest_words * 4)), 1,
            std::max<std::uint64_t>(number, 1));
        params.places = static_cast<std::uint32_t>(places);
    }
    // Without places nothing is suspended, but a kernel takes at least an element of each buffer.
    const std::uint64_t places = std::max(params.places, 1u);
    if (states_.size() < places * sizeof(NearestRecord)) {
        states_ = device_.allocate("nearest photons: states", places * sizeof(NearestRecord));
        words_ = device_.allocate("nearest photons: bins", places * nearest_words * 4);
    }

    const auto use = [&]<class Kernel>(std::type_identity<Kernel>) {
        const auto kernel = [&](const PhotonGatherParams& now, const Buffer& unfinished) {
            return Kernel{.nodes = map.lbvh.nodes,
                          .photons = map.photons,
                          .counters = map.counters,
                          .active_slots = queries.slots,
                          .counts = count.buffer,
                          .queries = queries.points,
                          .query_bsdfs = queries.bsdfs,
                          .states = states_,
                          .unfinished = unfinished,
                          .estimates = queries.estimates,
                          .suspended_words = words_,
                          .params = now,
                          .constants = {.glossy = plan_.needs(Feature::glossy_estimates),
                                        .final_gather = queries.final_gather,
                                        .caustics = plan_.needs(Feature::caustics),
                                        .material_features = plan_.material_features()}};
        };
        if (!queries.until_complete) {
            run_queries(device_, queries, params,
                        [&](const PhotonGatherParams& now, const Buffer& unfinished) {
                            dispatch_indirect(device_, kernel(now, unfinished), count.buffer,
                                              count.index);
                        });
            return;
        }
        for (std::uint64_t first = 0; first < number; first += places) {
            params.first_query = static_cast<std::uint32_t>(first);
            run_queries(device_, queries, params,
                        [&](const PhotonGatherParams& now, const Buffer& unfinished) {
                            dispatch(device_, kernel(now, unfinished),
                                     std::min(places, number - first));
                        });
        }
    };
    with_map_kernel<kernels::nearest_gather, kernels::nearest_gather_texels>(device_, map, use);
}

} // namespace argand
