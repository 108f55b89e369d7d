#ifndef ARGAND_SHARED_QUEUE_RECORDS_H
#define ARGAND_SHARED_QUEUE_RECORDS_H

#include "shared/footprint_records.h"

ARGAND_SHARED_BEGIN

// A node of the tree that divides space into the cells of a photon queue, in pre-order: the left
// child follows its parent. A point goes left if its coordinate is below the split, so that cells
// are half open.
struct CellNode {
    // The axis in the highest two bits, and the index of the right child. Axis 3: a leaf, with the
    // index of its cell.
    uint link;
    float32 split;
};

CONSTANT uint cell_axis_shift = 30u;
CONSTANT uint cell_link_mask = 0x3fffffffu;
CONSTANT uint cell_is_leaf = 3u;
// Levels of such a tree at most: code distances of lbvh_fit are below no_neighbour (morton.h).
CONSTANT uint most_cell_levels = 90u;

// A block of a photon queue: photons that were traced together, or the area samples.
struct QueueBlock {
    uint moment;    // when it was traced, from 1; 0: it is dropped; queue_always: never dropped
    float32 weight; // of its photons' flux
    uint first;     // of its records among the stored ones
    uint records;
};

CONSTANT uint queue_always = 0xffffffffu;

// An entry of the queue: a block above, a record of the block below.
CONSTANT uint queue_block_shift = 24u;
CONSTANT uint queue_record_mask = 0xffffffu;

// Beside each record whose path is kept.
struct QueuePathEnd {
    uint vertex;  // among its block's
    uint crossed; // blocks up to this moment lack some of such paths, so that they do not count
};

CONSTANT uint every_block = 0xffffffffu;

struct QueueParams {
    uint count;   // what the invocations go through
    uint cells;   // of all kinds
    uint caustic; // first cell of caustic photons, which lie in the same places as the others; 0:
                  // none
    uint block;   // the block of which the records are
    uint first;   // of the records
    uint blocks;
    uint moment;
    uint leaf_size;    // records that a cell should hold at most
    float32 reach;     // about moved boxes
    uint lights;       // that photons tell apart; 1: none
    uint first_vertex; // of the slots of a block whose path ends are new
    uint vertex_room;  // of each block
    uint boxes;        // moved ones
    uint pad0, pad1, pad2;
};

struct QueueFootprintParams {
    FootprintScale scale;
    float32 inverse_surface_area; // of the scene
    float32 area_widening;        // of area samples' footprints since they were made
    uint count;                   // records in the queue
    uint pad;
};

ARGAND_SHARED_END

#endif
