#include "photon/gather.hpp"

#include "kernels/photon_gather.hpp"
#include "kernels/photon_gather_texels.hpp"

namespace argand {

namespace {

struct Work {
    Device& device;
    const DeviceScene& scene;
    const PhotonMap& map;
    const GatherTarget& target;
    const GatherRadii& radii;
    const Count& asking;
    std::uint32_t budget;
};

template <class Kernel> void run(const Work& work, const Buffer& unfinished, bool first) {
    dispatch_indirect(work.device,
                      Kernel{.nodes = work.map.lbvh.nodes, .photons = work.map.photons, .counters = work.map.counters,
                             .active_slots = work.target.slots, .counts = work.target.counts,
                             .queries = work.target.queries, .materials = work.scene.materials,
                             .gathers = work.target.partial, .unfinished = unfinished, .layers = work.target.layers,
                             .params = {.radius = static_cast<float>(work.radii.indirect),
                                        .caustic_radius = static_cast<float>(work.radii.caustic),
                                        .budget = work.budget, .first = first ? 1u : 0u,
                                        .boundary_correction = work.map.area_samples > 0 ? 1u : 0u,
                                        .count_index = work.asking.index},
                             .constants = {.glossy = work.scene.has_glossy}},
                      work.asking.buffer, work.asking.index);
}

} // namespace

void gather_photons(Device& device, const DeviceScene& scene, const PhotonMap& map, const GatherTarget& target,
                    Traversal& traversal, const GatherRadii& radii, const Count& asking, std::uint32_t budget) {
    const StageScope stage(device, "gather photons");
    const Work work{device, scene, map, target, radii, asking, budget};
    const auto dispatch_all = read_as_texels(device, map.lbvh.nodes, map.photons) ? run<kernels::photon_gather_texels>
                                                                                   : run<kernels::photon_gather>;
    if (!traversal.careful) {
        dispatch_all(work, traversal.unfinished, true);
        return;
    }
    const Buffer unfinished = device.allocate("unfinished queries", 4);
    bool first = true;
    do {
        device.fill(unfinished, 0);
        dispatch_all(work, unfinished, first);
        first = false;
    } while (download<std::uint32_t>(device, unfinished, 1)[0] > 0);
}

} // namespace argand
