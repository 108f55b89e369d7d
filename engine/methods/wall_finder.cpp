#include "methods/wall_finder.hpp"

#include "kernels/wall_marks.hpp"
#include "kernels/wall_rays.hpp"

namespace argand {

void WallFinder::estimate(const PhotonMap& map, const PhotonQueries& queries) {
    estimator_.estimate(map, queries);
    if (queries.part == map_caustic || map.area_samples == 0) {
        return;
    }
    const StageScope stage(device_, "find walls");
    const WallParams params{.count_index = static_cast<std::uint32_t>(queries.count.index),
                            .error = position_error(scene_.record),
                            .pad0 = 0,
                            .pad1 = 0};
    dispatch_indirect(device_,
                      kernels::wall_rays{.active_slots = queries.slots,
                                         .counts = queries.count.buffer,
                                         .queries = queries.points,
                                         .estimates = queries.estimates,
                                         .rays = rays_,
                                         .params = params},
                      queries.count.buffer, queries.count.index);
    trace_any(device_, scene_.bvh, traversal_, {rays_, queries.slots, occluded_, queries.count});
    dispatch_indirect(device_,
                      kernels::wall_marks{.active_slots = queries.slots,
                                          .counts = queries.count.buffer,
                                          .occluded = occluded_,
                                          .estimates = queries.estimates,
                                          .params = params},
                      queries.count.buffer, queries.count.index);
}

} // namespace argand
