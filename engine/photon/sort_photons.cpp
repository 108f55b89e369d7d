#include "photon/sort_photons.hpp"

#include "kernels/photon_codes.hpp"
#include "kernels/photon_count.hpp"
#include "kernels/photon_footprints.hpp"
#include "kernels/photon_order.hpp"
#include "kernels/photon_places.hpp"
#include "kernels/photon_points.hpp"
#include "parallel/compact.hpp"
#include "parallel/radix_sort.hpp"
#include "parallel/reduce.hpp"
#include "shared/geometry_records.h"

namespace argand {

Buffer sort_places(Device& device, PhotonWorkspace& w, const Buffer& boxes, bool wide_codes) {
    const std::uint64_t bytes_of_codes = w.capacity * (wide_codes ? 8 : 4);
    if (w.codes.size() < bytes_of_codes) {
        w.codes = device.allocate("photon codes", bytes_of_codes);
    }
    const Count slots(w.counters, counter_stored_slots, w.capacity);
    Buffer bounds = device.scratch("photon map bounds", sizeof(BoxRecord));
    dispatch(device,
             kernels::photon_points{.counters = w.counters, .photons = w.photons, .boxes = boxes},
             slots);
    reduce_box(device, boxes, bounds, 0, slots);
    dispatch(device,
             kernels::photon_codes{.bounds = bounds,
                                   .counters = w.counters,
                                   .photons = w.photons,
                                   .codes = w.codes,
                                   .order = w.order,
                                   .constants = {.codes64 = wide_codes}},
             slots);
    if (wide_codes) {
        radix_sort_pairs64(device, w.codes, w.order, slots);
    } else {
        radix_sort_pairs(device, w.codes, w.order, slots);
    }
    upload_word(device, w.counters, counter_stored, 0);
    upload_word(device, w.counters, counter_others, 0);
    dispatch(device,
             kernels::photon_count{
                 .codes = w.codes, .counters = w.counters, .constants = {.codes64 = wide_codes}},
             slots);
    return bounds;
}

void list_places(Device& device, PhotonWorkspace& w) {
    const Count slots(w.counters, counter_stored_slots, w.capacity);
    dispatch(device,
             kernels::photon_places{
                 .photons = w.photons, .counters = w.counters, .heads = w.heads, .places = w.codes},
             slots);
    compact(device, w.heads, w.codes, w.order, {w.counters, counter_stored}, slots);
}

SortedPhotons sort_photons(Device& device, PhotonWorkspace& w, const StoredPhotons& stored) {
    const StageScope stage(device, "learn bandwidth");
    // Drops the area samples of a map that was built before.
    upload_word(device, w.counters, counter_stored_slots, static_cast<std::uint32_t>(stored.slots));
    SortedPhotons sorted;
    sorted.photons =
        unshared(device, w.last_sorted, "photons, sorted", w.capacity * sizeof(PhotonRecord));
    sorted.bounds = sort_places(device, w, sorted.photons, false);
    sorted.codes = w.codes;
    dispatch_indirect(device,
                      kernels::photon_order{.photons = w.photons,
                                            .order = w.order,
                                            .counters = w.counters,
                                            .sorted = sorted.photons},
                      w.counters, counter_stored);
    const auto counters = download<std::uint32_t>(device, w.counters, counter_count);
    sorted.others = counters[counter_others];
    sorted.caustics = counters[counter_stored] - sorted.others;
    return sorted;
}

void add_footprints(Device& device, PhotonWorkspace& w, const FootprintScale& scale,
                    SortedPhotons& sorted) {
    const StageScope stage(device, "learn bandwidth");
    sorted.footprints =
        unshared(device, w.last_footprints, "photon footprints", w.capacity * sizeof(glm::uvec4));
    const std::uint64_t photons = std::uint64_t(sorted.others) + sorted.caustics;
    dispatch(device,
             kernels::photon_footprints{.photons = w.photons,
                                        .order = w.order,
                                        .counters = w.counters,
                                        .offsets = w.offsets,
                                        .footprints = sorted.footprints,
                                        .shares = w.heads,
                                        .area_places = device.scratch("area samples' places", 4),
                                        .wide_caustics = device.scratch("wide caustics", 4),
                                        .params = {.scale = scale}},
             photons);
}

} // namespace argand
