#include "photon/gather.hpp"

#include "kernels/footprint_gather.hpp"
#include "kernels/footprint_gather_texels.hpp"
#include "kernels/leaf_discs.hpp"
#include "kernels/leaf_discs_texels.hpp"
#include "kernels/leaf_footprints.hpp"
#include "kernels/leaf_footprints_texels.hpp"
#include "kernels/photon_gather.hpp"
#include "kernels/photon_gather_texels.hpp"
#include "photon/covered_caustics.hpp"
#include "photon/gather_dispatch.hpp"
#include "photon/simultaneous.hpp"

namespace argand {

void RadiusEstimator::estimate(const PhotonMap& map, const PhotonQueries& queries) {
    const StageScope stage(device_, "gather photons");
    if (map.frontier) {
        estimate_simultaneously(map, queries);
        return;
    }
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
    if (radii_.caustic < radii_.indirect && queries.part != map_indirect && !disc_.ball) {
        correct_caustic_discs(device_, map, queries,
                              {.radius = radii_.caustic, .uniform_kernel = disc_.uniform_kernel});
    }
}

void RadiusEstimator::estimate_simultaneously(const PhotonMap& map, const PhotonQueries& queries) {
    const bool sharp = radii_.caustic < radii_.indirect;
    const Answering how{.reach = radii_.indirect,
                        .area_samples = disc_.ball ? 0 : map.area_samples,
                        .caustic_correction = !sharp,
                        .budget = budget_};
    answer_simultaneously<kernels::leaf_discs, kernels::leaf_discs_texels>(
        device_, map, queries, how,
        [&]<class Kernel>(FrontierGatherParams params, const kernels::FrontierBindings& bindings,
                          std::uint64_t threads) {
            params.radius = static_cast<float>(radii_.indirect);
            params.caustic_radius = static_cast<float>(radii_.caustic);
            dispatch(device_,
                     Kernel{.frontier = bindings,
                            .params = params,
                            .constants = {.frontier = frontier_constants(plan_, queries),
                                          .uniform_kernel = disc_.uniform_kernel,
                                          .ball = disc_.ball,
                                          .material_features = plan_.material_features()}},
                     threads);
        });
}

void FootprintEstimator::estimate(const PhotonMap& map, const PhotonQueries& queries) {
    const StageScope stage(device_, "gather photons");
    if (map.frontier) {
        estimate_simultaneously(map, queries);
        return;
    }
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

void FootprintEstimator::estimate_simultaneously(const PhotonMap& map,
                                                 const PhotonQueries& queries) {
    const Answering how{
        .area_samples = map.area_samples, .caustic_correction = false, .budget = budget_};
    answer_simultaneously<kernels::leaf_footprints, kernels::leaf_footprints_texels>(
        device_, map, queries, how,
        [&]<class Kernel>(FrontierGatherParams params, const kernels::FrontierBindings& bindings,
                          std::uint64_t threads) {
            params.flatness = map.flatness;
            dispatch(device_,
                     Kernel{.frontier = bindings,
                            .footprints = map.footprints,
                            .params = params,
                            .constants = {.frontier = frontier_constants(plan_, queries),
                                          .uniform_kernel = uniform_kernel_,
                                          .material_features = plan_.material_features()}},
                     threads);
        });
}

} // namespace argand
