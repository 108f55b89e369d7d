#include "photon/queue_map.hpp"

#include "kernels/queue_chains.hpp"
#include "kernels/queue_leaves.hpp"
#include "kernels/queue_map.hpp"
#include "parallel/reduce.hpp"
#include "parallel/scan.hpp"
#include "photon/queue_parts.hpp"

namespace argand {

namespace {

Buffer weights_by_light(Device& device, const PhotonQueue& q) {
    const std::uint64_t count = std::uint64_t(q.window) * q.lights;
    Buffer weights = scratch_words(device, "queue: weights by light", count);
    if (q.lights > 1) {
        device.upload(weights, 0, std::as_bytes(std::span(q.light_weights)));
    }
    return weights;
}

} // namespace

PhotonMap map_of_queue(Device& device, PhotonQueue& q, const SampledPart& corrected,
                       const std::optional<QueueFootprints>& footprints) {
    const StageScope stage(device, q.stage);
    PhotonMap map;
    map.area_samples = q.blocks[q.window].records;
    map.corrected = corrected;
    map.leaf_size = q.leaf_size;
    const std::uint64_t most_chains = q.entries / most_photons_a_leaf;
    const Buffer leaves = device.allocate("photon map leaves", std::uint64_t(q.cells) * 4);
    const Buffer chains = scratch_words(device, "queue: chains", q.cells);
    const Buffer crowded = scratch_words(device, "queue: crowded cells", q.cells);
    const Buffer leaf_boxes = device.scratch("queue: boxes of leaves", q.cells * sizeof(BoxRecord));
    const Buffer scales = scratch_words(device, "queue: scales", q.cells);
    const Buffer blocks = block_table(device, q);
    const Buffer boxes = footprints ? add_queue_footprints(device, q, *footprints, map) : q.boxes;
    dispatch(device,
             kernels::queue_leaves{.boxes = boxes,
                                   .starts = q.starts,
                                   .emptied = q.emptied,
                                   .blocks = blocks,
                                   .leaves = leaves,
                                   .more = chains,
                                   .crowded = crowded,
                                   .leaf_boxes = leaf_boxes,
                                   .scales = scales,
                                   .params = queue_params(q, q.cells)},
             q.cells);
    exclusive_scan(device, chains, chains, q.cells);
    map.photons =
        unshared(device, q.last_sorted, "photons, sorted", queue_room(q) * sizeof(PhotonRecord));
    dispatch(device,
             kernels::queue_map{
                 .entries = q.of_entry,
                 .cells = q.cell_of_entry,
                 .blocks = blocks,
                 .scales = scales,
                 .stored = q.stored,
                 .sorted = map.photons,
                 .weights = weights_by_light(device, q),
                 .stored_lights = q.light_indices,
                 .emptied = q.emptied,
                 .ends = q.path_ends,
                 .params = queue_params(q, q.entries),
                 .constants = {.keeps_lights = q.lights > 1, .keeps_paths = q.keeps_paths}},
             q.entries);
    std::vector<std::uint32_t> counters(counter_count, 0);
    counters[counter_stored] = static_cast<std::uint32_t>(q.entries);
    counters[counter_stored_slots] = counters[counter_stored];
    counters[counter_leaves] = q.entries > 0 ? q.cells : 0;
    map.counters = upload(device, "photon map counters", counters);
    map.lbvh = build_lbvh_in_order(device, leaf_boxes, q.distances, leaves,
                                   Count(map.counters, counter_leaves, q.cells + most_chains));
    dispatch(device,
             kernels::queue_chains{.starts = q.starts,
                                   .chains = chains,
                                   .nodes = map.lbvh.nodes,
                                   .params = queue_params(q, q.cells)},
             q.entries > 0 ? q.cells : 0);
    const Buffer total = scratch_words(device, "queue: crowded", 1);
    reduce_sum(device, crowded, total, 0, q.cells);
    q.crowded = download_word(device, total);
    if (q.crowded_when_divided == 0) {
        q.crowded_when_divided = std::max<std::uint64_t>(q.crowded, 1);
    }
    return map;
}

} // namespace argand
