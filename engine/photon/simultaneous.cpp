#include "photon/simultaneous.hpp"

#include "kernels/frontier_answer.hpp"

namespace argand {

void store_answers(Device& device, const PhotonMap& map, const PhotonQueries& queries,
                   std::uint32_t count, const Answering& how) {
    const PhotonGatherParams params = gather_params(map, queries, how.budget);
    dispatch(
        device,
        kernels::frontier_answer{.active_slots = queries.slots,
                                 .queries = queries.points,
                                 .gathers = queries.suspended,
                                 .estimates = queries.estimates,
                                 .params = {.end = count,
                                            .boundary_correction = how.area_samples > 0 ? 1u : 0u,
                                            .caustic_correction = how.caustic_correction ? 1u : 0u,
                                            .corrected_x = params.corrected_x,
                                            .corrected_y = params.corrected_y,
                                            .corrected_z = params.corrected_z,
                                            .corrected_distance = params.corrected_distance}},
        count);
}

} // namespace argand
