#ifndef ARGAND_SHARED_ACCEL_RECORDS_H
#define ARGAND_SHARED_ACCEL_RECORDS_H

#include "shared/parallel_records.h"

ARGAND_SHARED_BEGIN

// A reference to a node of an LBVH: 2 i for inner node i, 2 i + 1 for leaf i; it is also the node's
// place in memory, so that inner nodes and leaves lie interleaved (inner node n - 1 does not
// exist).
CONSTANT uint lbvh_end = 0xffffffffu;

// A node of an LBVH over n leaves in Karras's layout (2012): an inner node that covers leaves
// first..last is numbered first if it is a right child and last if it is a left child, the root 0;
// a node split after leaf s has children s and s + 1, each an inner node or a leaf. `child` refers
// to the left child of an inner node; of a leaf it is the index of the box. `escape` refers to the
// node that follows this one's whole subtree in depth-first order (lbvh_end: none), which for a
// left child is its sibling. So a traversal needs no stack: a reference is all its state.
struct LbvhNode {
    float32 low_x, low_y, low_z;
    uint child;
    float32 high_x, high_y, high_z;
    uint escape;
};

struct AccelParams {
    CountRecord count;
};

// What the surface area heuristic says of an inner node of the binary tree, as a forest of up to i
// nodes of the four-wide tree (Ylitie, Karras, Laine 2017, "Efficient incoherent ray traversal on
// GPUs through compressed wide BVHs", section 4): the expected costs for i of 1 to 3, and how they
// are reached. Bits of `split`: 0-1, the part of four children that is the left one's if the node
// becomes one of the wide tree; 2-3 and 4-5, how many nodes the forest for i of 2 and 3 really has;
// 6-7, the left one's part of three.
struct ForestCost {
    float32 one, two, three;
    uint split;
};

// A node of the four-wide tree that rays traverse: up to four boxes on a grid of 255 cells a side
// over their union. References are 2 i for node i and 2 i + 1 for triangle i of
// TriangleBvh::triangles.
struct RayNode {
    float32 low_x, low_y, low_z; // where the grid begins
    uint scales; // biased binary exponents of the cells' sizes, x lowest; highest 8 bits: children
    uint low_cells_x, low_cells_y, low_cells_z; // a byte per child, the first lowest
    uint high_cells_x, high_cells_y, high_cells_z;
    uint pad0, pad1;
    uint child0, child1, child2, child3;
};

// A triangle in the order of the leaves.
struct RayTriangle {
    float32 x0, y0, z0;
    uint triangle; // as numbered in the scene
    float32 x1, y1, z1;
    uint pad1;
    float32 x2, y2, z2;
    uint pad2;
};

// Children that a ray still has to visit in one node are one word: the node's index from bit 8 on,
// up to three numbers of children in bits 2 to 7, the next one lowest, and how many they are in
// bits 0 and 1. So many words wait at most: one a level, of which there are no more than bits in a
// code and in a leaf's place.
CONSTANT uint ray_stack_size = 62u;
CONSTANT uint max_ray_nodes = 0x1000000u;

// Traversal::suspended: the number of slots asked for, the number of rays that the last resume put
// aside again, then the slots. A slot: the ray, the node it is at (lbvh_end: it is done), the
// children it is at, the size of its stack, its stack.
CONSTANT uint suspended_head = 2u;
CONSTANT uint suspended_stride = 4u + 62u;

struct TraceParams {
    CountRecord count;
    uint first;      // of `active`; the count is then the end
    uint root;       // lbvh_end: there is no triangle
    uint step_limit; // boxes and triangles that a ray visits in one dispatch
    uint slot_count;
    uint last; // not 0: rays that are not done are counted, not suspended
};

ARGAND_SHARED_END

#endif
