#include "photon/gather.hpp"

#include "kernels/footprint_gather.hpp"
#include "kernels/footprint_gather_texels.hpp"
#include "kernels/photon_gather.hpp"
#include "kernels/photon_gather_texels.hpp"
#include "photon/gather_dispatch.hpp"

namespace argand {

void RadiusEstimator::estimate(const PhotonMap& map, const PhotonQueries& queries) {
    const StageScope stage(device_, "gather photons");
    PhotonGatherParams all = gather_params(map, queries, budget_);
    all.radius = static_cast<float>(radii_.indirect);
    all.caustic_radius = static_cast<float>(radii_.caustic);
    const auto use = [&]<class Kernel>(std::type_identity<Kernel>) {
        run_queries(device_, queries, all,
                    [&](const PhotonGatherParams& params, const Buffer& unfinished) {
                        dispatch_indirect(
                            device_,
                            Kernel{.nodes = map.lbvh.nodes,
                                   .photons = map.photons,
                                   .counters = map.counters,
                                   .active_slots = queries.slots,
                                   .counts = queries.count.buffer,
                                   .queries = queries.points,
                                   .query_bsdfs = queries.bsdfs,
                                   .gathers = queries.suspended,
                                   .unfinished = unfinished,
                                   .estimates = queries.estimates,
                                   .params = params,
                                   .constants = {.glossy = plan_.needs(Feature::glossy_estimates),
                                                 .final_gather = queries.final_gather,
                                                 .caustics = plan_.needs(Feature::caustics),
                                                 .material_features = plan_.material_features()}},
                            queries.count.buffer, queries.count.index);
                    });
    };
    with_map_kernel<kernels::photon_gather, kernels::photon_gather_texels>(device_, map, use);
}

void FootprintEstimator::estimate(const PhotonMap& map, const PhotonQueries& queries) {
    const StageScope stage(device_, "gather photons");
    PhotonGatherParams all = gather_params(map, queries, budget_);
    all.flatness = map.flatness;
    const auto use = [&]<class Kernel>(std::type_identity<Kernel>) {
        run_queries(device_, queries, all,
                    [&](const PhotonGatherParams& params, const Buffer& unfinished) {
                        dispatch_indirect(
                            device_,
                            Kernel{.nodes = map.lbvh.nodes,
                                   .photons = map.photons,
                                   .counters = map.counters,
                                   .active_slots = queries.slots,
                                   .counts = queries.count.buffer,
                                   .queries = queries.points,
                                   .query_bsdfs = queries.bsdfs,
                                   .gathers = queries.suspended,
                                   .unfinished = unfinished,
                                   .estimates = queries.estimates,
                                   .footprints = map.footprints,
                                   .params = params,
                                   .constants = {.glossy = plan_.needs(Feature::glossy_estimates),
                                                 .uniform_kernel = uniform_kernel_,
                                                 .final_gather = queries.final_gather,
                                                 .caustics = plan_.needs(Feature::caustics),
                                                 .material_features = plan_.material_features()}},
                            queries.count.buffer, queries.count.index);
                    });
    };
    with_map_kernel<kernels::footprint_gather, kernels::footprint_gather_texels>(device_, map, use);
}

} // namespace argand
