#pragma once

#include "photon/cell_tree.hpp"
#include "photon/photon_map.hpp"
#include "shared/geometry_records.h"

#include <cstdint>
#include <span>
#include <vector>

namespace argand {

/// A window of blocks of photons, as a queue: each frame adds one and drops the oldest (Shi 2012,
/// chapter 3). A tree of cells, which stays from frame to frame, says which photons lie together.
/// Records stay where their block was stored; their indices lie apart, in the order of the cells,
/// old ones before new ones.
struct PhotonQueue {
    std::uint32_t window = 1; ///< blocks of photons; the area samples are the one behind them
    std::uint32_t leaf_size = 16;
    bool footprints = false;  ///< estimates are those of footprints
    bool leaves_test = false; ///< each cell tests all new photons (Shi 2012, algorithm 1), instead
                              ///< of each photon descending to its cell
    const char* stage = "update queue"; ///< in which it is updated, and its maps are made
    std::uint32_t lights = 1;         ///< that photons tell apart; 1: they do not keep their lights
    std::vector<float> light_weights; ///< of photons, by block and light: block * lights + light
    bool keeps_paths = false;         ///< of photons (queue_paths.hpp)
    CellTree tree;                    ///< without nodes before the first block
    std::uint32_t cells = 0;          ///< twice those of the tree if caustic photons lie apart
    std::uint32_t caustic = 0;        ///< the first cell of caustic photons; 0: none
    std::uint64_t entries = 0;        ///< records that are in the queue
    std::uint64_t crowded = 0;        ///< records in cells that hold more than twice leaf_size
    std::uint64_t crowded_when_divided = 0;
    std::uint64_t divided_for = 0;  ///< records for which space was divided
    std::vector<QueueBlock> blocks; ///< window + 1
    std::uint64_t block_room = 0, area_room = 0;
    std::uint64_t vertex_room = 0; ///< of the paths of each block

    Buffer nodes;     ///< CellNode; empty: the cells are the leaves of a kd-tree
    Buffer kd_words;  ///< of this kd-tree
    Buffer extents;   ///< BoxRecord of each of the tree's cells, if leaves_test
    Buffer distances; ///< of cells from the next, for lbvh_fit
    Buffer boxes;     ///< see queue_box.h
    Buffer emptied;   ///< uint per cell: blocks up to this moment do not count there
    Buffer stored;    ///< PhotonRecord, by block
    /// uvec4 for each of these, if there are footprints: differentials of photons
    /// (PhotonWorkspace::offsets), and dual axes of area samples (queue_footprints.hpp).
    Buffer offsets;
    Buffer light_indices;  ///< uint for each of these: its light, if photons keep it
    Buffer path_ends;      ///< QueuePathEnd for each of these, if paths are kept
    Buffer vertices;       ///< PathVertex, by block: vertex_room * block + index
    double area_scale = 0; ///< FootprintScale::diffuse for which the latter were made; 0: not yet
    Buffer of_entry, cell_of_entry, starts;                ///< see queue_move.h
    Buffer next_of_entry, next_cell_of_entry, next_starts; ///< memory for the next ones
    Buffer last_sorted, last_footprints;                   ///< of the last map
};

/// An empty queue.
PhotonQueue make_photon_queue(std::uint32_t window, std::uint32_t leaf_size,
                              bool footprints = false);

/// Records to add to a queue, some of which may be empty slots.
struct QueueRecords {
    const Buffer& photons;
    std::uint64_t first = 0, slots = 0;
    std::uint64_t records = 0; ///< that are not empty
    Buffer offsets;            ///< of photons with footprints: PhotonWorkspace::offsets
    Buffer lights;             ///< of photons that keep their lights: PhotonWorkspace::lights
    Buffer vertices;           ///< of new photons whose paths are kept: PhotonWorkspace::vertices
    std::uint64_t paths = 0;   ///< photons emitted, to which these belong
    Buffer path_ends;          ///< QueuePathEnd of photons whose paths are in the queue
};

/// Empties the queue, and divides space into cells for these records, of whose photons there will
/// be `photon_weight` times as many. planes: see divide_cells(). parts_caustics: whether there may
/// be caustic photons, which lie in leaves of their own. Waits for the device.
void divide_queue(Device& device, PhotonQueue& queue, std::span<const CellNode> planes,
                  const QueueRecords& records, double photon_weight, bool parts_caustics);

/// Divides space anew for the records in the queue, and sorts them into the new cells. Not if
/// surfaces have moved since the oldest block was traced: see empty_near(). Waits for the device.
void divide_queue_anew(Device& device, PhotonQueue& queue, std::span<const CellNode> planes);

/// Whether search would gain from new cells: they were divided for fewer than half of the records,
/// and follow the noise of these few, or a quarter of the records lies in crowded ones, and twice
/// as many as when they were divided last.
bool is_crowded(const PhotonQueue& queue);

/// Drops a block and adds records in its place, traced at this moment (from 1 on, rising). Waits
/// for the device. Throws Error if the queue gets larger than the device can address.
void replace_block(Device& device, PhotonQueue& queue, std::uint32_t block, std::uint32_t moment,
                   const QueueRecords& records);

/// Drops, with the next block that is added, what lies near these boxes and was traced up to this
/// moment. Records only.
void empty_near(Device& device, PhotonQueue& queue, const std::vector<BoxRecord>& moved,
                double reach, std::uint32_t moment);

/// Sets the cells of an empty queue. Records only.
void set_queue_cells(Device& device, PhotonQueue& queue, CellTree tree, bool parts_caustics);

/// Makes the memory of so many cells, which are empty. Records only.
void make_cell_memory(Device& device, PhotonQueue& queue, std::uint32_t cells);

/// Makes memory of the queue's room, and keeps what is in the queue. before: the blocks where they
/// lie in the old memory. Throws Error if the device cannot address so much.
void allocate_queue(Device& device, PhotonQueue& queue, const std::vector<QueueBlock>& before);

} // namespace argand
