#include "photon/covered_caustics.hpp"

#include "kernels/caustic_cover.hpp"
#include "kernels/caustic_discs.hpp"

namespace argand {

namespace {

CoverParams cover_params(const PhotonMap& map) {
    CoverParams params{.samples_per_area = static_cast<float>(map.areas.samples_per_area),
                       .samples = map.areas.samples};
    set_corrected_part(params, map.corrected);
    return params;
}

} // namespace

Buffer wide_caustics(Device& device, const PhotonWorkspace& w) {
    return device.scratch("wide caustics", w.capacity * 4);
}

void correct_caustic_footprints(Device& device, const PhotonWorkspace& w, const PhotonMap& map,
                                bool uniform_kernel) {
    if (map.areas.samples == 0) {
        return;
    }
    CoverParams params = cover_params(map);
    params.flatness = map.flatness;
    dispatch_indirect(device,
                      kernels::caustic_cover{.nodes = map.areas.lbvh.nodes,
                                             .photons = map.photons,
                                             .counters = w.counters,
                                             .footprints = map.footprints,
                                             .wide_caustics = wide_caustics(device, w),
                                             .places = map.areas.places,
                                             .params = params,
                                             .constants = {.uniform_kernel = uniform_kernel}},
                      w.counters, counter_wide_caustics);
}

void correct_caustic_discs(Device& device, const PhotonMap& map, const PhotonQueries& queries,
                           const CausticDiscs& discs) {
    if (map.areas.samples == 0) {
        return;
    }
    CoverParams params = cover_params(map);
    params.squared_radius = static_cast<float>(discs.radius * discs.radius);
    params.count_index = queries.count.index;
    dispatch_indirect(device,
                      kernels::caustic_discs{.nodes = map.areas.lbvh.nodes,
                                             .places = map.areas.places,
                                             .photons = map.photons,
                                             .active_slots = queries.slots,
                                             .counts = queries.count.buffer,
                                             .queries = queries.points,
                                             .squared_radii = discs.squared_radii
                                                                  ? discs.squared_radii
                                                                  : queries.slots,
                                             .estimates = queries.estimates,
                                             .params = params,
                                             .constants = {.uniform_kernel = discs.uniform_kernel}},
                      queries.count.buffer, queries.count.index);
}

} // namespace argand
