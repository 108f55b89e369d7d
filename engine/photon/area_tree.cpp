#include "photon/area_tree.hpp"

#include "kernels/area_blocks.hpp"
#include "kernels/area_marks.hpp"
#include "parallel/compact.hpp"
#include "shared/geometry_records.h"
#include "shared/photon_records.h"

#include <algorithm>

namespace argand {

AreaTree build_area_tree(Device& device, const Buffer& records, const Buffer& counters,
                         std::uint32_t most_samples) {
    const std::uint64_t capacity = records.size() / sizeof(PhotonRecord);
    const Count count(counters, counter_stored, capacity);
    const Buffer marks = device.scratch("area samples' marks", capacity * 4);
    const Buffer indices = device.scratch("indices of records", capacity * 4);
    const std::uint64_t bound = std::max<std::uint64_t>(most_samples, 1);
    AreaTree tree{.places = device.allocate("area samples, in order", bound * 4)};
    dispatch(device,
             kernels::area_marks{
                 .photons = records, .counters = counters, .marks = marks, .indices = indices},
             count);
    compact(device, marks, indices, tree.places, {counters, counter_area_places}, count);
    tree.samples = download_word(device, counters, counter_area_places);
    const std::uint64_t blocks = (std::uint64_t(tree.samples) + area_block - 1) / area_block;
    const Buffer boxes = device.scratch("boxes of area samples",
                                        std::max<std::uint64_t>(blocks, 1) * sizeof(BoxRecord));
    dispatch(device,
             kernels::area_blocks{.photons = records,
                                  .places = tree.places,
                                  .boxes = boxes,
                                  .params = {.samples = tree.samples}},
             blocks);
    tree.lbvh = build_lbvh(device, boxes, Count(blocks));
    return tree;
}

} // namespace argand
