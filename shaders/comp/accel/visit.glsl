// Depth-first traversal of an LBVH (see LbvhNode) without a stack: a node's reference is all its state, so that it can
// be put aside and gone on with in a later dispatch. The includer declares the nodes as uvec4[] and defines
// LOAD_NODE(i) to read element i of it. Use:
//
//     uint node = lbvh_root(count);                        // or where an earlier dispatch stopped
//     for (uint step = 0u; node != lbvh_end && step < limit; ++step) {
//         LbvhVisit visit = lbvh_load(node);
//         bool inside = ...visit.low, visit.high...;
//         if (inside && lbvh_is_leaf(node)) {
//             ...box number visit.child...
//         }
//         node = lbvh_next(node, visit, inside);
//     }
#include "shared/accel_records.h"

struct LbvhVisit {
    vec3 low;
    uint child;
    vec3 high;
    uint escape;
};

uint lbvh_root(uint count) { return count == 0u ? lbvh_end : count == 1u ? 1u : 0u; }

bool lbvh_is_leaf(uint node) { return (node & 1u) != 0u; }

LbvhVisit lbvh_load(uint node) {
    uvec4 low = LOAD_NODE(2u * node);
    uvec4 high = LOAD_NODE(2u * node + 1u);
    return LbvhVisit(uintBitsToFloat(low.xyz), low.w, uintBitsToFloat(high.xyz), high.w);
}

// The first child of an inner node that is to be looked into, else what follows its subtree.
uint lbvh_next(uint node, LbvhVisit visit, bool inside) {
    return inside && !lbvh_is_leaf(node) ? visit.child : visit.escape;
}
