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
    all.boundary_correction = disc_.ball ? 0u : all.boundary_correction;
    gather<kernels::photon_gather, kernels::photon_gather_texels>(
        device_, map, queries, all,
        [&]<class Kernel>(const PhotonGatherParams& params,
                          const kernels::QueryBindings& bindings) {
            dispatch_indirect(device_,
                              Kernel{.query = bindings,
                                     .gathers = queries.suspended,
                                     .params = params,
                                     .constants = {.query = query_constants(plan_, queries),
                                                   .uniform_kernel = disc_.uniform_kernel,
                                                   .ball = disc_.ball,
                                                   .material_features = plan_.material_features()}},
                              queries.count.buffer, queries.count.index);
        });
}

void FootprintEstimator::estimate(const PhotonMap& map, const PhotonQueries& queries) {
    const StageScope stage(device_, "gather photons");
    PhotonGatherParams all = gather_params(map, queries, budget_);
    all.flatness = map.flatness;
    gather<kernels::footprint_gather, kernels::footprint_gather_texels>(
        device_, map, queries, all,
        [&]<class Kernel>(const PhotonGatherParams& params,
                          const kernels::QueryBindings& bindings) {
            dispatch_indirect(device_,
                              Kernel{.query = bindings,
                                     .gathers = queries.suspended,
                                     .footprints = map.footprints,
                                     .params = params,
                                     .constants = {.query = query_constants(plan_, queries),
                                                   .uniform_kernel = uniform_kernel_,
                                                   .material_features = plan_.material_features()}},
                              queries.count.buffer, queries.count.index);
        });
}

} // namespace argand
