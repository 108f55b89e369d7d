#include "photon/queue_footprints.hpp"

#include "device/copy_elements.hpp"
#include "kernels/photon_order.hpp"
#include "kernels/queue_area_footprints.hpp"
#include "kernels/queue_footprints.hpp"
#include "kernels/queue_offsets.hpp"
#include "parallel/reduce.hpp"
#include "photon/queue_map.hpp"
#include "photon/queue_parts.hpp"
#include "photon/sort_photons.hpp"

namespace argand {

Buffer add_queue_footprints(Device& device, PhotonQueue& q, const QueueFootprints& how,
                            PhotonMap& map) {
    map.footprints = unshared(device, q.last_footprints, "photon footprints",
                              queue_room(q) * sizeof(glm::uvec4));
    map.flatness = how.scale.flatness;
    Buffer boxes = scratch_words(device, "queue: boxes around footprints", 6ull * q.cells);
    device.fill(boxes, 0xffffffffu);
    const FootprintParams params = footprint_params(how.scene, how.scale, map.area_samples);
    const double widening = q.area_scale > 0 ? double(how.scale.diffuse) / q.area_scale : 1;
    const Buffer shares = scratch_words(device, "queue: footprints' shares", q.entries);
    dispatch(
        device,
        kernels::queue_footprints{.entries = q.of_entry,
                                  .cells = q.cell_of_entry,
                                  .blocks = block_table(device, q),
                                  .stored = q.stored,
                                  .stored_offsets = q.offsets,
                                  .footprints = map.footprints,
                                  .shares = shares,
                                  .boxes = boxes,
                                  .params = {.scale = how.scale,
                                             .inverse_surface_area = params.inverse_surface_area,
                                             .area_widening = static_cast<float>(widening),
                                             .count = static_cast<uint>(q.entries)}},
        q.entries);
    const Buffer sum = scratch_words(device, "queue: footprints", 1);
    reduce_sum(device, shares, sum, 0, q.entries);
    map.mean_footprints = double(download_word(device, sum)) / area_shares;
    return boxes;
}

void copy_to_workspace(Device& device, const PhotonQueue& q, const Buffer& photons,
                       PhotonWorkspace& w) {
    if (w.capacity < q.entries || (w.extents != extents_none) != q.footprints) {
        w = PhotonWorkspace(); // frees the old one's memory before the new one takes its own
        w = make_photon_workspace(device, q.entries,
                                  {.extents = q.footprints ? extents_differentials : extents_none});
    }
    copy_elements(device, photons, 0, w.photons, 0, q.entries, sizeof(PhotonRecord));
    if (q.footprints) {
        dispatch(device,
                 kernels::queue_offsets{.entries = q.of_entry,
                                        .blocks = block_table(device, q),
                                        .stored_offsets = q.offsets,
                                        .offsets = w.offsets,
                                        .params = queue_params(q, q.entries)},
                 q.entries);
    }
    device.fill(w.counters, 0);
    upload_word(device, w.counters, counter_stored_slots, static_cast<std::uint32_t>(q.entries));
}

void size_area_footprints(Device& device, PhotonQueue& q, PhotonWorkspace& w,
                          const QueueFootprints& how) {
    q.area_scale = how.scale.diffuse;
    PhotonMap map = map_of_queue(device, q, {});
    if (map.area_samples == 0) {
        return;
    }
    const StageScope stage(device, q.stage);
    copy_to_workspace(device, q, map.photons, w);
    map.photons =
        unshared(device, w.last_sorted, "photons, sorted", w.capacity * sizeof(PhotonRecord));
    sort_places(device, w, map.photons, true);
    dispatch_indirect(
        device,
        kernels::photon_order{
            .photons = w.photons, .order = w.order, .counters = w.counters, .sorted = map.photons},
        w.counters, counter_stored);
    make_footprints(device, how.scene, w, how.scale, map);
    dispatch(device,
             kernels::queue_area_footprints{.entries = q.of_entry,
                                            .blocks = block_table(device, q),
                                            .order = w.order,
                                            .footprints = map.footprints,
                                            .stored_offsets = q.offsets,
                                            .params = queue_params(q, q.entries)},
             q.entries);
}

} // namespace argand
