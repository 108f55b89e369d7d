#include "photon/gather.hpp"

#include "kernels/footprint_gather.hpp"
#include "kernels/footprint_gather_texels.hpp"
#include "kernels/photon_gather.hpp"
#include "kernels/photon_gather_texels.hpp"

namespace argand {

namespace {

struct Work {
    Device& device;
    const DeviceScene& scene;
    const PhotonMap& map;
    const GatherTarget& target;
    const Count& asking;
    PhotonGatherParams params;
    bool uniform_kernel = false;
};

/// One dispatch of all queries: the first one, or one that goes on with those that are unfinished.
using Run = void (*)(const Work& work, const Buffer& unfinished);

template <class Kernel> void run_radius(const Work& work, const Buffer& unfinished) {
    dispatch_indirect(
        work.device,
        Kernel{.nodes = work.map.lbvh.nodes,
               .photons = work.map.photons,
               .counters = work.map.counters,
               .active_slots = work.target.slots,
               .counts = work.target.counts,
               .queries = work.target.queries,
               .materials = work.scene.materials,
               .gathers = work.target.partial,
               .unfinished = unfinished,
               .estimates = work.target.estimates,
               .params = work.params,
               .constants = {.glossy = work.scene.plan.needs(Feature::glossy_estimates),
                             .final_gather = work.target.final_gather,
                             .caustics = work.scene.plan.needs(Feature::caustics),
                             .material_features = work.scene.plan.material_features()}},
        work.asking.buffer, work.asking.index);
}

template <class Kernel> void run_footprints(const Work& work, const Buffer& unfinished) {
    dispatch_indirect(
        work.device,
        Kernel{.nodes = work.map.lbvh.nodes,
               .photons = work.map.photons,
               .counters = work.map.counters,
               .active_slots = work.target.slots,
               .counts = work.target.counts,
               .queries = work.target.queries,
               .materials = work.scene.materials,
               .gathers = work.target.partial,
               .unfinished = unfinished,
               .estimates = work.target.estimates,
               .footprints = work.map.footprints,
               .params = work.params,
               .constants = {.glossy = work.scene.plan.needs(Feature::glossy_estimates),
                             .uniform_kernel = work.uniform_kernel,
                             .final_gather = work.target.final_gather,
                             .caustics = work.scene.plan.needs(Feature::caustics),
                             .material_features = work.scene.plan.material_features()}},
        work.asking.buffer, work.asking.index);
}

/// Dispatches once, or if that is called for until no query is left.
void gather(Work work, Traversal& traversal, Run storage, Run texels) {
    const StageScope stage(work.device, "gather photons");
    const Run run =
        read_as_texels(work.device, work.map.lbvh.nodes, work.map.photons) ? texels : storage;
    work.params.first = 1;
    work.params.count_index = work.asking.index;
    work.params.part = work.target.part;
    work.params.boundary_correction = work.map.area_samples > 0 ? 1 : 0;
    if (!traversal.careful) {
        run(work, traversal.unfinished);
        return;
    }
    const Buffer unfinished = work.device.allocate("unfinished queries", 4);
    do {
        work.device.fill(unfinished, 0);
        run(work, unfinished);
        work.params.first = 0;
    } while (download<std::uint32_t>(work.device, unfinished, 1)[0] > 0);
}

} // namespace

void gather_photons(Device& device, const DeviceScene& scene, const PhotonMap& map,
                    const GatherTarget& target, Traversal& traversal, const GatherRadii& radii,
                    const Count& asking, std::uint32_t budget) {
    gather({.device = device,
            .scene = scene,
            .map = map,
            .target = target,
            .asking = asking,
            .params = {.budget = budget,
                       .radius = static_cast<float>(radii.indirect),
                       .caustic_radius = static_cast<float>(radii.caustic)}},
           traversal, run_radius<kernels::photon_gather>,
           run_radius<kernels::photon_gather_texels>);
}

void gather_footprints(Device& device, const DeviceScene& scene, const PhotonMap& map,
                       const GatherTarget& target, Traversal& traversal, bool uniform_kernel,
                       const Count& asking, std::uint32_t budget) {
    gather({.device = device,
            .scene = scene,
            .map = map,
            .target = target,
            .asking = asking,
            .params = {.budget = budget, .flatness = map.flatness},
            .uniform_kernel = uniform_kernel},
           traversal, run_footprints<kernels::footprint_gather>,
           run_footprints<kernels::footprint_gather_texels>);
}

} // namespace argand
