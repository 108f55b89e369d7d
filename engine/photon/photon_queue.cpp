#include "photon/photon_queue.hpp"

#include "base/error.hpp"
#include "device/copy_elements.hpp"
#include "kernels/queue_cells.hpp"
#include "kernels/queue_chains.hpp"
#include "kernels/queue_empty.hpp"
#include "kernels/queue_ends.hpp"
#include "kernels/queue_insert.hpp"
#include "kernels/queue_keep.hpp"
#include "kernels/queue_leaves.hpp"
#include "kernels/queue_map.hpp"
#include "kernels/queue_move.hpp"
#include "kernels/queue_starts.hpp"
#include "kernels/queue_store.hpp"
#include "parallel/radix_sort.hpp"
#include "parallel/reduce.hpp"
#include "parallel/scan.hpp"
#include "shared/morton.h"
#include "shared/photon.h"

#include <algorithm>
#include <bit>

namespace argand {

namespace {

// Room for blocks that store more photons than the first one.
constexpr std::uint64_t headroom_divisor = 4;

std::uint64_t room(const PhotonQueue& q) { return q.window * q.block_room + q.area_room; }

std::uint32_t first_of(const PhotonQueue& q, std::uint32_t block) {
    return static_cast<std::uint32_t>(block * q.block_room); // the area samples lie behind all
}

Buffer block_table(Device& device, const PhotonQueue& q) {
    Buffer table = device.scratch("queue: blocks", q.blocks.size() * sizeof(QueueBlock));
    device.upload(table, 0, std::as_bytes(std::span(q.blocks)));
    return table;
}

QueueParams params_of(const PhotonQueue& q, std::uint64_t count) {
    QueueParams params{};
    params.count = static_cast<uint>(count);
    params.cells = q.cells;
    params.caustic = q.caustic;
    params.blocks = q.window;
    params.leaf_size = q.leaf_size;
    return params;
}

Buffer words(Device& device, const char* name, std::uint64_t count) {
    return device.scratch(name, std::max<std::uint64_t>(count, 1) * sizeof(std::uint32_t));
}

/// Makes room for so many records in a block, and keeps those that are in the queue.
void make_block_room(Device& device, PhotonQueue& q, std::uint32_t block, std::uint64_t records) {
    const bool areas = block == q.window;
    std::uint64_t& wanted = areas ? q.area_room : q.block_room;
    if (q.stored && records <= wanted) {
        return;
    }
    wanted = std::max<std::uint64_t>(records + (areas ? 0 : records / headroom_divisor), 1);
    if (room(q) > max_stored_photons(device)) {
        wanted = records;
    }
    const std::vector<QueueBlock> before = q.blocks;
    for (std::uint32_t b = 0; b < q.blocks.size(); ++b) {
        q.blocks[b].first = first_of(q, b);
    }
    allocate_queue(device, q, before);
}

/// Records in the order of their cells.
struct SortedRecords {
    Buffer cells, order, starts; ///< as kernels queue_cells and queue_starts write them
};

SortedRecords sort_into_cells(Device& device, const PhotonQueue& q, const QueueRecords& records) {
    SortedRecords sorted{words(device, "queue: cells of a block", records.slots),
                         words(device, "queue: order of a block", records.slots),
                         words(device, "queue: starts of a block", q.cells + 1ull)};
    QueueParams params = params_of(q, records.slots);
    params.first = static_cast<uint>(records.first);
    dispatch(device,
             kernels::queue_cells{.nodes = q.nodes,
                                  .photons = records.photons,
                                  .cells = sorted.cells,
                                  .order = sorted.order,
                                  .params = params},
             records.slots);
    radix_sort_pairs(device, sorted.cells, sorted.order, records.slots,
                     static_cast<std::uint32_t>(std::bit_width(q.cells)));
    dispatch(
        device,
        kernels::queue_starts{.cells = sorted.cells, .starts = sorted.starts, .params = params},
        q.cells + 1ull);
    return sorted;
}

/// The ranks of the entries that stay, and their number behind them.
Buffer rank_kept(Device& device, const PhotonQueue& q) {
    Buffer ranks = words(device, "queue: ranks", q.entries + 1);
    dispatch(device,
             kernels::queue_keep{.entries = q.of_entry,
                                 .cells = q.cell_of_entry,
                                 .blocks = block_table(device, q),
                                 .emptied = q.emptied,
                                 .flags = ranks,
                                 .params = params_of(q, q.entries)},
             q.entries + 1);
    exclusive_scan(device, ranks, ranks, q.entries + 1);
    return ranks;
}

/// Places of records that are not empty.
void add_points(Device& device, const QueueRecords& records, double photon_weight,
                std::vector<glm::vec4>& points) {
    if (records.slots == 0) {
        return;
    }
    const auto all = download<PhotonRecord>(device, records.photons, records.slots, records.first);
    points.reserve(points.size() + records.records);
    for (const PhotonRecord& p : all) {
        if (p.normal != no_photon) {
            const bool area = (p.normal & area_sample_bit) != 0;
            points.emplace_back(p.x, p.y, p.z, area ? 1.0f : static_cast<float>(photon_weight));
        }
    }
}

QueueRecords records_of(const QueueBlock& block, const Buffer& stored) {
    return {stored, block.first, block.records, block.records};
}

} // namespace

PhotonQueue make_photon_queue(std::uint32_t window, std::uint32_t leaf_size) {
    PhotonQueue q;
    q.window = window;
    q.leaf_size = leaf_size;
    q.blocks.resize(window + 1ull);
    return q;
}

void set_queue_cells(Device& device, PhotonQueue& q, CellTree tree, bool parts_caustics) {
    q.tree = std::move(tree);
    q.caustic = parts_caustics ? q.tree.cells : 0;
    q.cells = q.tree.cells * (parts_caustics ? 2 : 1);
    std::vector<std::uint32_t> distances;
    distances.reserve(q.cells);
    for (std::uint32_t kind = 0; kind < q.cells / q.tree.cells; ++kind) {
        for (const std::uint32_t level : q.tree.levels) {
            distances.push_back(kind_distance - 1 - level);
        }
        distances.push_back(kind_distance); // of caustic photons from all others
    }
    distances.back() = no_neighbour;
    q.nodes = upload(device, "queue: tree of cells", q.tree.nodes);
    q.distances = upload(device, "queue: distances of cells", distances);
    const auto per_cell = [&](const char* name, std::uint64_t each, std::uint32_t value) {
        Buffer buffer = device.allocate(name, (q.cells + 1ull) * each * 4);
        device.fill(buffer, value);
        return buffer;
    };
    q.boxes = per_cell("queue: boxes of cells", 6, 0xffffffffu);
    q.emptied = per_cell("queue: emptied cells", 1, 0);
    q.starts = per_cell("queue: starts of cells", 1, 0);
    q.next_starts = per_cell("queue: next starts of cells", 1, 0);
    q.entries = 0;
}

void allocate_queue(Device& device, PhotonQueue& q, const std::vector<QueueBlock>& before) {
    if (room(q) > max_stored_photons(device) || q.block_room > queue_record_mask) {
        fail("keeping photons from frame to frame: {} blocks of {} records each and {} area "
             "samples are more than '{}' can address; use fewer photons",
             q.window, q.block_room, q.area_room, device.info().name);
    }
    const auto grown = [&](const char* name, const Buffer& old, std::uint64_t elements) {
        Buffer buffer = device.allocate(name, room(q) * 4);
        copy_elements(device, old, 0, buffer, 0, elements, 4);
        return buffer;
    };
    const Buffer old = q.stored;
    q.stored = device.allocate("queue: photons", room(q) * sizeof(PhotonRecord));
    for (std::size_t b = 0; b < q.blocks.size(); ++b) {
        copy_elements(device, old, before[b].first, q.stored, q.blocks[b].first, before[b].records,
                      sizeof(PhotonRecord));
    }
    q.of_entry = grown("queue: entries", q.of_entry, q.entries);
    q.cell_of_entry = grown("queue: cells of entries", q.cell_of_entry, q.entries);
    q.next_of_entry = grown("queue: next entries", Buffer(), 0);
    q.next_cell_of_entry = grown("queue: next cells of entries", Buffer(), 0);
}

void divide_queue(Device& device, PhotonQueue& q, std::span<const CellNode> planes,
                  const QueueRecords& records, double photon_weight, bool parts_caustics) {
    const StageScope stage(device, "divide queue");
    std::vector<glm::vec4> points;
    add_points(device, records, photon_weight, points);
    set_queue_cells(device, q,
                    divide_cells(planes, std::move(points), q.leaf_size, parts_caustics ? 2 : 1),
                    parts_caustics);
    for (QueueBlock& block : q.blocks) {
        block = {};
    }
    q.crowded_when_divided = 0;
    q.divided_for = records.records;
}

void divide_queue_anew(Device& device, PhotonQueue& q, std::span<const CellNode> planes) {
    std::vector<QueueBlock> blocks = q.blocks;
    const Buffer stored = q.stored;
    {
        const StageScope stage(device, "divide queue");
        std::vector<glm::vec4> points;
        for (const QueueBlock& block : blocks) {
            add_points(device, records_of(block, stored), 1, points);
        }
        set_queue_cells(device, q,
                        divide_cells(planes, std::move(points), q.leaf_size, q.caustic > 0 ? 2 : 1),
                        q.caustic > 0);
    }
    q.stored = Buffer(); // blocks are sorted from the old memory into new memory
    for (QueueBlock& block : q.blocks) {
        block = {};
    }
    // In the order of time, which is that of the entries of a cell.
    std::vector<std::uint32_t> order;
    order.reserve(blocks.size());
    for (std::uint32_t b = 0; b < blocks.size(); ++b) {
        order.push_back(b);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return blocks[a].moment < blocks[b].moment;
    });
    for (const std::uint32_t b : order) {
        if (blocks[b].moment > 0) {
            replace_block(device, q, b, blocks[b].moment, records_of(blocks[b], stored));
            q.blocks[b].weight = blocks[b].weight;
        }
    }
    q.crowded_when_divided = 0;
    q.divided_for = q.entries;
}

bool is_crowded(const PhotonQueue& q) {
    return q.entries > 2 * q.divided_for ||
           (4 * q.crowded > q.entries && q.crowded > 2 * q.crowded_when_divided);
}

void replace_block(Device& device, PhotonQueue& q, std::uint32_t block, std::uint32_t moment,
                   const QueueRecords& records) {
    const StageScope stage(device, "update queue");
    // What is dropped is not copied to larger memory.
    q.blocks[block].moment = 0;
    q.blocks[block].records = 0;
    make_block_room(device, q, block, records.records);
    const SortedRecords fresh = sort_into_cells(device, q, records);
    const Buffer ranks = rank_kept(device, q);
    q.blocks[block] = {moment, 0, first_of(q, block), static_cast<uint>(records.records)};
    QueueParams params = params_of(q, records.slots);
    params.first = static_cast<uint>(records.first);
    params.block = block;
    dispatch(device,
             kernels::queue_store{.photons = records.photons,
                                  .cells = fresh.cells,
                                  .order = fresh.order,
                                  .blocks = block_table(device, q),
                                  .boxes = q.boxes,
                                  .stored = q.stored,
                                  .params = params},
             records.slots);
    dispatch(device,
             kernels::queue_move{.entries = q.of_entry,
                                 .cells = q.cell_of_entry,
                                 .ranks = ranks,
                                 .fresh_starts = fresh.starts,
                                 .next_entries = q.next_of_entry,
                                 .next_cells = q.next_cell_of_entry,
                                 .params = params_of(q, q.entries)},
             q.entries);
    dispatch(device,
             kernels::queue_insert{.cells = fresh.cells,
                                   .ranks = ranks,
                                   .starts = q.starts,
                                   .next_entries = q.next_of_entry,
                                   .next_cells = q.next_cell_of_entry,
                                   .params = params},
             records.slots);
    dispatch(device,
             kernels::queue_ends{.ranks = ranks,
                                 .starts = q.starts,
                                 .fresh_starts = fresh.starts,
                                 .next_starts = q.next_starts,
                                 .params = params},
             q.cells + 1ull);
    std::swap(q.of_entry, q.next_of_entry);
    std::swap(q.cell_of_entry, q.next_cell_of_entry);
    std::swap(q.starts, q.next_starts);
    q.entries = download_word(device, q.starts, q.cells);
}

void empty_near(Device& device, PhotonQueue& q, const std::vector<BoxRecord>& moved, double reach,
                std::uint32_t moment) {
    if (moved.empty() || q.cells == 0) {
        return;
    }
    QueueParams params = params_of(q, moved.size());
    params.reach = static_cast<float>(reach);
    params.moment = moment;
    dispatch(device,
             kernels::queue_empty{.boxes = q.boxes,
                                  .moved = upload(device, "queue: moved boxes", moved),
                                  .emptied = q.emptied,
                                  .params = params},
             q.cells);
}

PhotonMap map_of_queue(Device& device, PhotonQueue& q, const SampledPart& corrected) {
    const StageScope stage(device, "update queue");
    PhotonMap map;
    map.area_samples = q.blocks[q.window].records;
    map.corrected = corrected;
    map.leaf_size = q.leaf_size;
    const std::uint64_t most_chains = q.entries / most_photons_a_leaf;
    const Buffer leaves = device.allocate("photon map leaves", std::uint64_t(q.cells) * 4);
    const Buffer chains = words(device, "queue: chains", q.cells);
    const Buffer crowded = words(device, "queue: crowded cells", q.cells);
    const Buffer leaf_boxes = device.scratch("queue: boxes of leaves", q.cells * sizeof(BoxRecord));
    const Buffer scales = words(device, "queue: scales", q.cells);
    const Buffer blocks = block_table(device, q);
    dispatch(device,
             kernels::queue_leaves{.boxes = q.boxes,
                                   .starts = q.starts,
                                   .emptied = q.emptied,
                                   .blocks = blocks,
                                   .leaves = leaves,
                                   .more = chains,
                                   .crowded = crowded,
                                   .leaf_boxes = leaf_boxes,
                                   .scales = scales,
                                   .params = params_of(q, q.cells)},
             q.cells);
    exclusive_scan(device, chains, chains, q.cells);
    map.photons =
        unshared(device, q.last_sorted, "photons, sorted", room(q) * sizeof(PhotonRecord));
    dispatch(device,
             kernels::queue_map{.entries = q.of_entry,
                                .cells = q.cell_of_entry,
                                .blocks = blocks,
                                .scales = scales,
                                .stored = q.stored,
                                .sorted = map.photons,
                                .params = params_of(q, q.entries)},
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
                                   .params = params_of(q, q.cells)},
             q.entries > 0 ? q.cells : 0);
    const Buffer total = words(device, "queue: crowded", 1);
    reduce_sum(device, crowded, total, 0, q.cells);
    q.crowded = download_word(device, total);
    if (q.crowded_when_divided == 0) {
        q.crowded_when_divided = std::max<std::uint64_t>(q.crowded, 1);
    }
    return map;
}

} // namespace argand
