#include "shared/kernels/accel/forest.h"

// Decides which inner nodes of the binary tree become nodes of the four-wide tree. That depends on
// how many nodes the parent allows, and so on all ancestors; but after a few of them the next one
// hardly ever matters.
FN void main() {
    uint node = THREAD_INDEX;
    if (node + 1u >= params.count.number) {
        return;
    }
    // How many nodes this node is allowed if the current ancestor is allowed 1, 2 or 3.
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
