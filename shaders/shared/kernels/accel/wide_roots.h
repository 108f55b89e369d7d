#include "shared/kernels/accel/forest.h"

// Whether each inner node of the binary tree becomes one of the four-wide tree. That depends on how
// many nodes its parent allows it, on all ancestors thus; but after a few of them hardly ever on
// what the next one is allowed.
FN void main() {
    uint node = THREAD_INDEX;
    if (node + 1u >= params.count.number) {
        return;
    }
    // What the node is allowed if the ancestor that the loop is at is allowed 1, 2 or 3.
    uvec3 allowed = uvec3(1u, 2u, 3u);
    uint ancestor = parents[node];
    while (ancestor != lbvh_end && !(allowed.x == allowed.y && allowed.y == allowed.z)) {
        uint split = costs[ancestor >> 1u].w;
        bool right = (ancestor & 1u) != 0u;
        uvec3 part =
            uvec3(child_part(split, 1u, right), child_part(split, forest_size(split, 2u), right),
                  child_part(split, forest_size(split, 3u), right));
        allowed = uvec3(allowed[part.x - 1u], allowed[part.y - 1u], allowed[part.z - 1u]);
        ancestor = parents[ancestor >> 1u];
    }
    roots[node] = forest_size(costs[node].w, allowed.x) == 1u ? 1u : 0u;
}
