#include "photon/queue_paths.hpp"

#include "device/copy_elements.hpp"
#include "kernels/queue_paths.hpp"
#include "parallel/reduce.hpp"
#include "photon/box_around.hpp"
#include "photon/queue_parts.hpp"

#include <algorithm>
#include <map>

namespace argand {

namespace {

// Of one moment. A photon's path is tested against those of a window's moments.
constexpr std::size_t most_boxes = 16;

/// Finds which photons of a block cross boxes. Returns a flag for each entry.
Buffer test_paths(Device& device, const PhotonQueue& q, std::uint32_t block,
                  const MovedBoxes& moved, bool marks) {
    Buffer counts = scratch_words(device, "queue: crossed paths", q.entries);
    QueueParams params = queue_params(q, q.entries);
    params.block = block;
    params.boxes = static_cast<uint>(moved.boxes.size());
    dispatch(device,
             kernels::queue_paths{.entries = q.of_entry,
                                  .blocks = block_table(device, q),
                                  .vertices = q.vertices,
                                  .moved = upload(device, "queue: moved boxes", moved.boxes),
                                  .moments = upload(device, "queue: their moments", moved.moments),
                                  .ends = q.path_ends,
                                  .counts = counts,
                                  .params = params,
                                  .constants = {.marks = marks}},
             q.entries);
    return counts;
}

} // namespace

void add_moved_boxes(MovedBoxes& moved, std::span<const BoxRecord> boxes, std::uint32_t moment,
                     double error) {
    const std::size_t each = (boxes.size() + most_boxes - 1) / most_boxes;
    for (std::size_t first = 0; first < boxes.size(); first += each) {
        BoxRecord box = boxes[first];
        for (std::size_t i = first + 1; i < std::min(first + each, boxes.size()); ++i) {
            box = box_around(box, boxes[i]);
        }
        const auto by = static_cast<float>(error);
        moved.boxes.push_back({box.low_x - by, box.low_y - by, box.low_z - by, 0, box.high_x + by,
                               box.high_y + by, box.high_z + by, 0});
        moved.moments.push_back(moment);
    }
}

void forget_moved_boxes(MovedBoxes& moved, std::uint32_t moment) {
    // Moments rise.
    const auto first = std::upper_bound(moved.moments.begin(), moved.moments.end(), moment) -
                       moved.moments.begin();
    moved.moments.erase(moved.moments.begin(), moved.moments.begin() + first);
    moved.boxes.erase(moved.boxes.begin(), moved.boxes.begin() + first);
}

void keep_paths(Device& device, PhotonQueue& q, std::uint32_t block, const QueueRecords& records) {
    const std::uint64_t count = 2 * records.paths + records.first + records.slots;
    if (!q.vertices || count > q.vertex_room) {
        const Buffer old = q.vertices;
        const std::uint64_t room = std::max<std::uint64_t>(count + count / 4, 1);
        if (q.window * room * sizeof(PathVertex) > device.info().limits.storage_range) {
            q.keeps_paths = false;
            return;
        }
        q.vertices =
            device.allocate("queue: vertices of paths", q.window * room * sizeof(PathVertex));
        for (std::uint32_t b = 0; b < q.window; ++b) {
            copy_elements(device, old, b * q.vertex_room, q.vertices, b * room,
                          old ? q.vertex_room : 0, sizeof(PathVertex));
        }
        q.vertex_room = room;
    }
    copy_elements(device, records.vertices, 0, q.vertices, block * q.vertex_room, count,
                  sizeof(PathVertex));
}

double share_crossed(Device& device, const PhotonQueue& q, std::uint32_t block,
                     const MovedBoxes& moved) {
    if (q.entries == 0 || q.blocks[block].records == 0 || moved.boxes.empty()) {
        return 0;
    }
    const Buffer counts = test_paths(device, q, block, moved, false);
    const Buffer sum = scratch_words(device, "queue: crossed", 1);
    reduce_sum(device, counts, sum, 0, q.entries);
    return double(download_word(device, sum)) / double(q.blocks[block].records);
}

void mark_crossed(Device& device, const PhotonQueue& q, std::uint32_t block,
                  const MovedBoxes& moved) {
    if (q.entries > 0 && !moved.boxes.empty()) {
        test_paths(device, q, block, moved, true);
    }
}

std::vector<CrossedShare> crossed_shares(Device& device, const PhotonQueue& q, std::uint32_t block,
                                         const MovedBoxes& moved) {
    const std::uint32_t records = q.blocks[block].records;
    if (!q.keeps_paths || records == 0 || moved.boxes.empty()) {
        return {{0, 1}};
    }
    std::map<std::uint32_t, std::uint64_t> counts;
    for (const QueuePathEnd& end :
         download<QueuePathEnd>(device, q.path_ends, records, q.blocks[block].first)) {
        ++counts[end.crossed];
    }
    std::vector<CrossedShare> shares;
    shares.reserve(counts.size());
    for (const auto& [moment, count] : counts) {
        shares.push_back({moment, double(count) / records});
    }
    return shares;
}

} // namespace argand
