#ifndef ARGAND_SHARED_ACCEL_RECORDS_H
#define ARGAND_SHARED_ACCEL_RECORDS_H

#include "shared/parallel_records.h"

ARGAND_SHARED_BEGIN

// Reference to a node of an LBVH: 2 i for inner node i, 2 i + 1 for leaf i. The reference is also
// the node's index in memory, so inner nodes and leaves are interleaved (inner node n - 1 does not
// exist). lbvh_end refers to no node.
CONSTANT uint lbvh_end = 0xffffffffu;

// A node of an LBVH over n leaves in Karras's layout (2012). An inner node that covers leaves
// first..last is numbered `first` if it is a right child and `last` if it is a left child; the root
// is 0. A node that is split after leaf s has the children s and s + 1, each an inner node or a
// leaf.
//
// `child` refers to the left child of an inner node; in a leaf it is the index of the leaf's box.
// `escape` refers to the node that follows this node's subtree in depth-first order (lbvh_end:
// none); for a left child that is its sibling. So a traversal needs no stack: a reference is its
// whole state.
struct LbvhNode {
    float32 low_x, low_y, low_z;
    uint child;
    float32 high_x, high_y, high_z;
    uint escape;
};

struct AccelParams {
    CountRecord count;
};

// Costs of collapsing an inner node of the binary tree into the four-wide tree, by the surface area
// heuristic (Ylitie, Karras, Laine 2017, "Efficient incoherent ray traversal on GPUs through
// compressed wide BVHs", section 4). `one`, `two` and `three` are the expected costs if a forest of
// at most 1, 2 or 3 four-wide nodes represents the subtree. The bits of `split` say how to reach
// them:
// - 0-1: how many of the four children the left child provides if the node becomes a four-wide node
// - 2-3 and 4-5: how many nodes the forests of at most 2 and 3 really have
// - 6-7: how many of three nodes the left child provides
struct ForestCost {
    float32 one, two, three;
    uint split;
};

// A node of the four-wide tree that rays traverse: up to four boxes, quantised to a grid of 255
// cells a side over their union. A child reference is 2 i for node i and 2 i + 1 for triangle i of
// TriangleBvh::triangles.
struct RayNode {
    float32 low_x, low_y, low_z; // origin of the grid
    // Biased binary exponents of the cell sizes, x in the lowest byte; highest byte: number of
    // children.
    uint scales;
    uint low_cells_x, low_cells_y, low_cells_z; // one byte per child, the first lowest
    uint high_cells_x, high_cells_y, high_cells_z;
    uint pad0, pad1;
    uint child0, child1, child2, child3;
};

// A triangle, stored in the order of the leaves.
struct RayTriangle {
    float32 x0, y0, z0;
    uint triangle; // index in the scene
    float32 x1, y1, z1;
    uint pad1;
    float32 x2, y2, z2;
    uint pad2;
};

// An entry of a ray's stack holds the children of one node that the ray has yet to visit: the
// node's index from bit 8 on, up to three child numbers in bits 2 to 7 (the next one lowest), and
// their count in bits 0 and 1. The stack needs one entry per level, and the tree has at most as
// many levels as a Morton code and a leaf's index have bits.
CONSTANT uint ray_stack_size = 62u;
CONSTANT uint max_ray_nodes = 0x1000000u;

// Layout of Traversal::suspended in words: the number of slots requested, the number of rays that
// the last resume suspended again, then the slots. A slot holds the ray, its current node
// (lbvh_end: the ray is done), the children left to visit there, the height of its stack, the
// stack, and the triangle and distance of the hit behind which the ray goes on.
CONSTANT uint suspended_head = 2u;
CONSTANT uint suspended_passed = 4u + ray_stack_size;
CONSTANT uint suspended_stride = suspended_passed + 2u;

struct TraceParams {
    CountRecord count;
    uint first;      // index into `active`; `count` is then the end of the range
    uint root;       // lbvh_end: the scene has no triangle
    uint step_limit; // boxes and triangles that a ray may visit in one dispatch
    uint slot_count;
    uint last; // not 0: unfinished rays are counted, not suspended
};

ARGAND_SHARED_END

#endif
