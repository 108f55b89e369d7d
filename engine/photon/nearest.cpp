#include "photon/nearest.hpp"

#include "kernels/nearest_gather.hpp"
#include "kernels/nearest_gather_texels.hpp"
#include "shared/nearest_records.h"

#include <algorithm>

namespace argand {

namespace {

template <class Kernel>
Kernel make_kernel(const DeviceScene& scene, const PhotonMap& map, const GatherTarget& target,
                   const Buffer& unfinished, const Buffer& states, const Buffer& words,
                   const PhotonGatherParams& params) {
    return {.nodes = map.lbvh.nodes,
            .photons = map.photons,
            .counters = map.counters,
            .active_slots = target.slots,
            .counts = target.counts,
            .queries = target.queries,
            .materials = scene.materials,
            .states = states,
            .unfinished = unfinished,
            .estimates = target.estimates,
            .suspended_words = words,
            .params = params,
            .constants = {.glossy = scene.plan.needs(Feature::glossy_estimates),
                          .final_gather = target.final_gather,
                          .caustics = scene.plan.needs(Feature::caustics),
                          .material_features = scene.plan.material_features()}};
}

} // namespace

void gather_nearest(Device& device, const DeviceScene& scene, const PhotonMap& map,
                    const GatherTarget& target, Traversal& traversal,
                    const NearestSettings& settings, const Count& asking, std::uint32_t budget) {
    const StageScope stage(device, "gather photons");
    const bool texels = read_as_texels(device, map.lbvh.nodes, map.photons);
    PhotonGatherParams params{.budget = budget, .first = 1, .count_index = asking.index};
    params.boundary_correction = map.area_samples > 0 ? 1 : 0;
    params.radius = static_cast<float>(settings.radius);
    params.neighbours = settings.neighbours;
    params.part = target.part;
    params.samples_per_area = static_cast<float>(settings.samples_per_area);
    const char* const words_name = "nearest photons: bins";
    if (!traversal.careful) {
        const Buffer states = device.scratch(nearest_states, sizeof(NearestRecord));
        const Buffer words = device.scratch(words_name, 4);
        const auto run = [&](const auto& kernel) {
            dispatch_indirect(device, kernel, asking.buffer, asking.index);
        };
        if (texels) {
            run(make_kernel<kernels::nearest_gather_texels>(
                scene, map, target, traversal.unfinished, states, words, params));
        } else {
            run(make_kernel<kernels::nearest_gather>(scene, map, target, traversal.unfinished,
                                                     states, words, params));
        }
        return;
    }
    // So many at a time as there is memory for putting them aside.
    const std::uint64_t queries =
        download<std::uint32_t>(device, asking.buffer, 1, asking.index)[0];
    const std::uint64_t places = std::clamp<std::uint64_t>(
        std::min(nearest_places, device.info().limits.storage_range / (nearest_words * 4)), 1,
        std::max<std::uint64_t>(queries, 1));
    const Buffer states = device.scratch(nearest_states, places * sizeof(NearestRecord));
    const Buffer words = device.scratch(words_name, places * nearest_words * 4);
    const Buffer unfinished = device.allocate("unfinished queries", 4);
    params.places = static_cast<std::uint32_t>(places);
    for (std::uint64_t first = 0; first < queries; first += places) {
        params.first_query = static_cast<std::uint32_t>(first);
        params.first = 1;
        do {
            device.fill(unfinished, 0);
            const auto run = [&](const auto& kernel) {
                dispatch(device, kernel, std::min(places, queries - first));
            };
            if (texels) {
                run(make_kernel<kernels::nearest_gather_texels>(scene, map, target, unfinished,
                                                                states, words, params));
            } else {
                run(make_kernel<kernels::nearest_gather>(scene, map, target, unfinished, states,
                                                         words, params));
            }
            params.first = 0;
        } while (download<std::uint32_t>(device, unfinished, 1)[0] > 0);
    }
}

} // namespace argand
