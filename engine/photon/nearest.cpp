#include "photon/nearest.hpp"

#include "kernels/nearest_gather.hpp"
#include "kernels/nearest_gather_texels.hpp"
#include "photon/covered_caustics.hpp"
#include "photon/gather_dispatch.hpp"
#include "shared/nearest_records.h"

#include <algorithm>

namespace argand {

void NearestEstimator::estimate(const PhotonMap& map, const PhotonQueries& queries) {
    const StageScope stage(device_, "gather photons");
    const Count& count = queries.count;
    PhotonGatherParams params = gather_params(map, queries, budget_);
    if (queries.part == map_caustic && settings_.caustic_neighbours > 0) {
        params.radius = static_cast<float>(settings_.caustic_radius);
        params.neighbours = settings_.caustic_neighbours;
    } else {
        params.radius = static_cast<float>(settings_.radius);
        params.neighbours = settings_.neighbours;
        params.samples_per_area = static_cast<float>(settings_.samples_per_area);
    }

    std::uint64_t number = 0;
    if (queries.until_complete) {
        number = download_word(device_, count.buffer, count.index);
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

    const std::uint64_t slots = queries.estimates.size() / sizeof(EstimateRecord);
    const bool discs = queries.part == map_caustic;
    const Buffer caustic_discs =
        device_.scratch("nearest photons: caustic discs", (discs ? slots : 1) * sizeof(float));

    const auto run = [&](const auto& dispatch_kernel) {
        gather<kernels::nearest_gather, kernels::nearest_gather_texels>(
            device_, map, queries, params,
            [&]<class Kernel>(const PhotonGatherParams& now,
                              const kernels::QueryBindings& bindings) {
                dispatch_kernel(
                    Kernel{.query = bindings,
                           .states = states_,
                           .suspended_words = words_,
                           .caustic_discs = caustic_discs,
                           .params = now,
                           .constants = {.query = query_constants(plan_, queries),
                                         .material_features = plan_.material_features()}});
            });
    };
    if (!queries.until_complete) {
        run([&](const auto& kernel) {
            dispatch_indirect(device_, kernel, count.buffer, count.index);
        });
    }
    for (std::uint64_t first = 0; first < number; first += places) {
        params.first_query = static_cast<std::uint32_t>(first);
        run([&](const auto& kernel) {
            dispatch(device_, kernel, std::min(places, number - first));
        });
    }
    if (discs) {
        correct_caustic_discs(device_, map, queries, {.squared_radii = caustic_discs});
    }
}

} // namespace argand
