#ifndef ARGAND_SHARED_ACCEL_RECORDS_H
#define ARGAND_SHARED_ACCEL_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// A reference to a node of an LBVH: 2 i for inner node i, 2 i + 1 for leaf i; it is also the node's place in memory,
// so that inner nodes and leaves lie interleaved (inner node n - 1 does not exist).
CONSTANT uint lbvh_end = 0xffffffffu;

// A node of an LBVH over n leaves in Karras's layout (2012): an inner node that covers leaves first..last is numbered
// first if it is a right child and last if it is a left child, the root 0; a node split after leaf s has children s
// and s + 1, each an inner node or a leaf. `child` refers to the left child of an inner node; of a leaf it is the
// index of the box. `escape` refers to the node that follows this one's whole subtree in depth-first order (lbvh_end:
// none), which for a left child is its sibling. So a traversal needs no stack: a reference is all its state.
struct LbvhNode {
    float32 low_x, low_y, low_z;
    uint child;
    float32 high_x, high_y, high_z;
    uint escape;
};

// A number of elements: `count`, or where count_index is not no_count_index the uint of that index in a buffer.
CONSTANT uint no_count_index = 0xffffffffu;

struct AccelParams {
    uint count;
    uint count_index;
};

// Both children of an inner node of the two-wide tree that rays traverse; their references as above, with a leaf's
// index being that of its triangle in TriangleBvh::triangles.
struct RayNode {
    float32 left_low_x, left_low_y, left_low_z;
    uint left;
    float32 left_high_x, left_high_y, left_high_z;
    uint right;
    float32 right_low_x, right_low_y, right_low_z;
    uint pad0;
    float32 right_high_x, right_high_y, right_high_z;
    uint pad1;
};

// A triangle in the order of the leaves.
struct RayTriangle {
    float32 x0, y0, z0;
    uint triangle;      // as numbered in the scene
    float32 x1, y1, z1;
    uint pad1;
    float32 x2, y2, z2;
    uint pad2;
};

// Most nodes that wait on a traversal's stack: one per level, of which there are at most as many as bits in a code and
// in a leaf's place.
CONSTANT uint ray_stack_size = 62u;

// Traversal::suspended: the number of slots asked for, the number of rays that the last resume put aside again, then
// the slots. A slot: the ray, the node it is at (lbvh_end: it is done), the size of its stack, its stack.
CONSTANT uint suspended_head = 2u;
CONSTANT uint suspended_stride = 3u + 62u;

struct TraceParams {
    uint count;
    uint count_index;
    uint first;             // of `active`; count is then the end
    uint root;              // lbvh_end: there is no triangle
    uint step_limit;        // boxes and triangles that a ray visits in one dispatch
    uint slot_count;
    uint last;              // not 0: rays that are not done are counted, not suspended
};

ARGAND_SHARED_END

#endif
