#include "photon/queue_kdtree.hpp"

#include "kernels/queue_kd_distances.hpp"
#include "kernels/queue_points.hpp"
#include "photon/queue_parts.hpp"

namespace argand {

PhotonQueue sort_by_kdtree(Device& device, const PhotonWorkspace& w, std::uint64_t records,
                           double reach, std::uint32_t leaf_size, bool parts_caustics) {
    PhotonQueue q = make_photon_queue(1, leaf_size, w.extents != extents_none);
    q.stage = "build photon kd-tree";
    KdTree tree;
    {
        const StageScope stage(device, q.stage);
        const Buffer boxes = device.allocate(
            "boxes of photons", std::max<std::uint64_t>(records, 1) * sizeof(BoxRecord));
        dispatch(device,
                 kernels::queue_points{
                     .photons = w.photons, .boxes = boxes, .params = queue_params(q, records)},
                 records);
        tree = build_kdtree(
            device, boxes, static_cast<std::uint32_t>(records),
            {.points = true, .reach = static_cast<float>(reach), .leaf_size = leaf_size});
        q.kd_words = tree.words;
        // A part of the map is a node with children: a leaf may have further ones behind it.
        q.tree.cells = std::max(tree.leaf_count, parts_caustics ? 2u : 1u);
        q.caustic = parts_caustics ? q.tree.cells : 0;
        make_cell_memory(device, q, q.tree.cells * (parts_caustics ? 2 : 1));
        q.distances = device.allocate("queue: distances of cells", q.cells * 4ull);
        dispatch(device,
                 kernels::queue_kd_distances{.words = tree.words,
                                             .addresses = tree.addresses,
                                             .distances = q.distances,
                                             .params = queue_params(q, tree.leaf_count)},
                 q.cells);
    }
    replace_block(device, q, 0, 1, {w.photons, 0, records, records, w.offsets});
    q.blocks[0].weight = 1;
    return q;
}

} // namespace argand
