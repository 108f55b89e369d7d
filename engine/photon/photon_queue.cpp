#include "photon/photon_queue.hpp"

#include "base/error.hpp"
#include "device/copy_elements.hpp"
#include "kernels/queue_cells.hpp"
#include "kernels/queue_empty.hpp"
#include "kernels/queue_ends.hpp"
#include "kernels/queue_insert.hpp"
#include "kernels/queue_kd_cells.hpp"
#include "kernels/queue_keep.hpp"
#include "kernels/queue_leaf_count.hpp"
#include "kernels/queue_leaf_list.hpp"
#include "kernels/queue_move.hpp"
#include "kernels/queue_starts.hpp"
#include "kernels/queue_store.hpp"
#include "parallel/radix_sort.hpp"
#include "parallel/scan.hpp"
#include "photon/queue_parts.hpp"
#include "photon/queue_paths.hpp"
#include "shared/morton.h"
#include "shared/photon.h"

#include <algorithm>
#include <bit>

namespace argand {

namespace {

// Room for blocks that store more photons than the first one.
constexpr std::uint64_t headroom_divisor = 4;
constexpr std::uint32_t no_cell = 0xffffffffu;

std::uint32_t first_of(const PhotonQueue& q, std::uint32_t block) {
    return static_cast<std::uint32_t>(block * q.block_room); // the area samples lie behind all
}

/// Makes room for so many records in a block, and keeps those that are in the queue.
void make_block_room(Device& device, PhotonQueue& q, std::uint32_t block, std::uint64_t records) {
    const bool areas = block == q.window;
    std::uint64_t& wanted = areas ? q.area_room : q.block_room;
    if (q.stored && records <= wanted) {
        return;
    }
    wanted = std::max<std::uint64_t>(records + (areas ? 0 : records / headroom_divisor), 1);
    if (queue_room(q) > max_stored_photons(device)) {
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

/// Each record descends to its cell; then they are sorted.
void descend_into_cells(Device& device, const PhotonQueue& q, const QueueRecords& records,
                        const SortedRecords& sorted) {
    QueueParams params = queue_params(q, records.slots);
    params.first = static_cast<uint>(records.first);
    if (q.nodes) {
        dispatch(device,
                 kernels::queue_cells{.nodes = q.nodes,
                                      .photons = records.photons,
                                      .cells = sorted.cells,
                                      .order = sorted.order,
                                      .params = params},
                 records.slots);
    } else {
        dispatch(device,
                 kernels::queue_kd_cells{.words = q.kd_words,
                                         .photons = records.photons,
                                         .cells = sorted.cells,
                                         .order = sorted.order,
                                         .params = params},
                 records.slots);
    }
    radix_sort_pairs(device, sorted.cells, sorted.order, records.slots,
                     static_cast<std::uint32_t>(std::bit_width(q.cells)));
    dispatch(
        device,
        kernels::queue_starts{.cells = sorted.cells, .starts = sorted.starts, .params = params},
        q.cells + 1ull);
}

/// Each cell tests all records, and lists its own: the same result.
void test_in_cells(Device& device, const PhotonQueue& q, const QueueRecords& records,
                   const SortedRecords& sorted) {
    // Well below 65,535 iterations, at which lavapipe ends loops silently.
    constexpr std::uint64_t most_tests = 16384;
    const auto in_parts = [&](const auto& run) {
        for (std::uint64_t first = 0; first < records.slots; first += most_tests) {
            QueueParams params = queue_params(q, std::min(most_tests, records.slots - first));
            params.first = static_cast<uint>(records.first + first);
            params.block = static_cast<uint>(first);
            run(params);
        }
    };
    const Buffer places = scratch_words(device, "queue: places in cells", q.cells + 1ull);
    device.fill(places, 0);
    in_parts([&](const QueueParams& params) {
        dispatch(device,
                 kernels::queue_leaf_count{.extents = q.extents,
                                           .photons = records.photons,
                                           .counts = places,
                                           .params = params},
                 q.cells);
    });
    exclusive_scan(device, places, sorted.starts, q.cells + 1ull);
    copy_elements(device, sorted.starts, 0, places, 0, q.cells, 4);
    device.fill(sorted.cells, no_cell);
    in_parts([&](const QueueParams& params) {
        dispatch(device,
                 kernels::queue_leaf_list{.extents = q.extents,
                                          .photons = records.photons,
                                          .places = places,
                                          .cells = sorted.cells,
                                          .order = sorted.order,
                                          .params = params},
                 q.cells);
    });
}

SortedRecords sort_into_cells(Device& device, const PhotonQueue& q, const QueueRecords& records) {
    SortedRecords sorted{scratch_words(device, "queue: cells of a block", records.slots),
                         scratch_words(device, "queue: order of a block", records.slots),
                         scratch_words(device, "queue: starts of a block", q.cells + 1ull)};
    if (q.leaves_test) {
        test_in_cells(device, q, records, sorted);
    } else {
        descend_into_cells(device, q, records, sorted);
    }
    return sorted;
}

/// The ranks of the entries that stay, and their number behind them.
Buffer rank_kept(Device& device, const PhotonQueue& q) {
    Buffer ranks = scratch_words(device, "queue: ranks", q.entries + 1);
    dispatch(device,
             kernels::queue_keep{.entries = q.of_entry,
                                 .cells = q.cell_of_entry,
                                 .blocks = block_table(device, q),
                                 .emptied = q.emptied,
                                 .flags = ranks,
                                 .ends = q.path_ends ? q.path_ends : q.starts,
                                 .params = queue_params(q, q.entries),
                                 .constants = {.keeps_paths = q.keeps_paths}},
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

QueueRecords records_of(const QueueBlock& block, const PhotonQueue& memory) {
    return {.photons = memory.stored,
            .first = block.first,
            .slots = block.records,
            .records = block.records,
            .offsets = memory.offsets,
            .lights = memory.light_indices,
            .path_ends = memory.path_ends};
}

} // namespace

PhotonQueue make_photon_queue(std::uint32_t window, std::uint32_t leaf_size, bool footprints) {
    PhotonQueue q;
    q.window = window;
    q.leaf_size = leaf_size;
    q.footprints = footprints;
    q.blocks.resize(window + 1ull);
    return q;
}

void set_queue_cells(Device& device, PhotonQueue& q, CellTree tree, bool parts_caustics) {
    q.tree = std::move(tree);
    q.caustic = parts_caustics ? q.tree.cells : 0;
    const std::uint32_t kinds = parts_caustics ? 2 : 1;
    std::vector<std::uint32_t> distances;
    distances.reserve(std::size_t(kinds) * q.tree.cells);
    for (std::uint32_t kind = 0; kind < kinds; ++kind) {
        for (const std::uint32_t level : q.tree.levels) {
            distances.push_back(kind_distance - 1 - level);
        }
        distances.push_back(kind_distance); // of caustic photons from all others
    }
    distances.back() = no_neighbour;
    q.nodes = upload(device, "queue: tree of cells", q.tree.nodes);
    if (q.leaves_test) {
        q.extents = upload(device, "queue: extents of cells", cell_extents(q.tree));
    }
    make_cell_memory(device, q, kinds * q.tree.cells);
    q.distances = upload(device, "queue: distances of cells", distances);
}

void make_cell_memory(Device& device, PhotonQueue& q, std::uint32_t cells) {
    q.cells = cells;
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
    if (queue_room(q) > max_stored_photons(device) || q.block_room > queue_record_mask) {
        fail("keeping photons from frame to frame: {} blocks of {} records each and {} area "
             "samples are more than '{}' can address; use fewer photons",
             q.window, q.block_room, q.area_room, device.info().name);
    }
    const auto grown = [&](const char* name, const Buffer& old, std::uint64_t elements) {
        Buffer buffer = device.allocate(name, queue_room(q) * 4);
        copy_elements(device, old, 0, buffer, 0, elements, 4);
        return buffer;
    };
    const Buffer old = q.stored;
    q.stored = device.allocate("queue: photons", queue_room(q) * sizeof(PhotonRecord));
    for (std::size_t b = 0; b < q.blocks.size(); ++b) {
        copy_elements(device, old, before[b].first, q.stored, q.blocks[b].first, before[b].records,
                      sizeof(PhotonRecord));
    }
    // What is kept beside each record, if it is.
    const auto beside = [&](const char* name, Buffer& buffer, bool kept, std::uint64_t bytes) {
        const Buffer last = buffer;
        buffer = device.allocate(name, (kept ? queue_room(q) : 1) * bytes);
        for (std::size_t b = 0; kept && b < q.blocks.size(); ++b) {
            copy_elements(device, last, before[b].first, buffer, q.blocks[b].first,
                          before[b].records, bytes);
        }
    };
    beside("queue: differentials", q.offsets, q.footprints, sizeof(glm::uvec4));
    beside("queue: lights", q.light_indices, q.lights > 1, 4);
    beside("queue: ends of paths", q.path_ends, q.keeps_paths, sizeof(QueuePathEnd));
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
    const PhotonQueue old = q; // shares its memory
    std::vector<QueueBlock> blocks = q.blocks;
    {
        const StageScope stage(device, "divide queue");
        std::vector<glm::vec4> points;
        for (const QueueBlock& block : blocks) {
            add_points(device, records_of(block, old), 1, points);
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
            replace_block(device, q, b, blocks[b].moment, records_of(blocks[b], old));
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
    const StageScope stage(device, q.stage);
    // What is dropped is not copied to larger memory.
    q.blocks[block].moment = 0;
    q.blocks[block].records = 0;
    make_block_room(device, q, block, records.records);
    const SortedRecords fresh = sort_into_cells(device, q, records);
    const Buffer ranks = rank_kept(device, q);
    q.blocks[block] = {moment, 0, first_of(q, block), static_cast<uint>(records.records)};
    QueueParams params = queue_params(q, records.slots);
    params.first = static_cast<uint>(records.first);
    params.block = block;
    params.first_vertex = static_cast<uint>(2 * records.paths);
    if (q.keeps_paths && records.vertices) {
        keep_paths(device, q, block, records);
    }
    dispatch(device,
             kernels::queue_store{.photons = records.photons,
                                  .cells = fresh.cells,
                                  .order = fresh.order,
                                  .blocks = block_table(device, q),
                                  .boxes = q.boxes,
                                  .stored = q.stored,
                                  .offsets = q.footprints ? records.offsets : q.distances,
                                  .stored_offsets = q.offsets,
                                  .photon_lights = q.lights > 1 ? records.lights : q.distances,
                                  .stored_lights = q.light_indices,
                                  .ends = records.path_ends ? records.path_ends : q.distances,
                                  .stored_ends = q.path_ends,
                                  .params = params,
                                  .constants = {.footprints = q.footprints,
                                                .keeps_lights = q.lights > 1,
                                                .keeps_paths = q.keeps_paths,
                                                .new_paths = q.keeps_paths && !records.path_ends}},
             records.slots);
    dispatch(device,
             kernels::queue_move{.entries = q.of_entry,
                                 .cells = q.cell_of_entry,
                                 .ranks = ranks,
                                 .fresh_starts = fresh.starts,
                                 .next_entries = q.next_of_entry,
                                 .next_cells = q.next_cell_of_entry,
                                 .params = queue_params(q, q.entries)},
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
    QueueParams params = queue_params(q, moved.size());
    params.reach = static_cast<float>(reach);
    params.moment = moment;
    dispatch(device,
             kernels::queue_empty{.boxes = q.boxes,
                                  .moved = upload(device, "queue: moved boxes", moved),
                                  .emptied = q.emptied,
                                  .params = params},
             q.cells);
}

} // namespace argand
