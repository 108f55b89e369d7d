#include "photon/gather.hpp"

#include "kernels/photon_gather.hpp"

namespace argand {

void gather_photons(Device& device, const DeviceScene& scene, const PhotonMap& map, const GatherTarget& target,
                    Traversal& traversal, const GatherRadii& radii, const Count& asking, std::uint32_t budget) {
    const StageScope stage(device, "gather photons");
    const auto run = [&](const Buffer& unfinished, bool first) {
        dispatch_indirect(device,
                          kernels::photon_gather{.active_slots = target.slots, .counts = target.counts,
                                                 .queries = target.queries, .materials = scene.materials,
                                                 .nodes = map.lbvh.nodes, .photons = map.photons,
                                                 .counters = map.counters, .gathers = target.partial,
                                                 .unfinished = unfinished, .layers = target.layers,
                                                 .params = {.radius = static_cast<float>(radii.indirect),
                                                            .caustic_radius = static_cast<float>(radii.caustic),
                                                            .budget = budget, .first = first ? 1u : 0u,
                                                            .boundary_correction = map.area_samples > 0 ? 1u : 0u,
                                                            .count_index = asking.index},
                                                 .constants = {.glossy = scene.has_glossy}},
                          asking.buffer, asking.index);
    };
    if (!traversal.careful) {
        run(traversal.unfinished, true);
        return;
    }
    const Buffer unfinished = device.allocate("unfinished queries", 4);
    bool first = true;
    do {
        device.fill(unfinished, 0);
        run(unfinished, first);
        first = false;
    } while (download<std::uint32_t>(device, unfinished, 1)[0] > 0);
}

} // namespace argand
