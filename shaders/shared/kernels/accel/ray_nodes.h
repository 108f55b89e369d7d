#include "shared/kernels/accel/forest.h"
#include "shared/kernels/accel/node_grid.h"

// ranks: inclusive sums of the flags written by wide_roots.
FN bool is_wide(uint node) { return ranks[node] != (node > 0u ? ranks[node - 1u] : 0u); }

// Writes the nodes of the four-wide tree, with their children's boxes rounded outwards to the grid.
FN void main() {
    uint node = THREAD_INDEX;
    if (node + 1u >= params.count.number || !is_wide(node)) {
        return;
    }
    uint split = costs[node].w;
    uint children[4];
    uint parts[4];
    children[0] = tree[4u * node].w;
    children[1] = tree[2u * children[0] + 1u].w; // a left child escapes to its sibling
    parts[0] = left_part(split, 1u);
    parts[1] = 4u - parts[0];
    uint count = 2u;
    for (uint i = 0u; i < count;) {
        uint child = children[i];
        uint child_split = (child & 1u) == 0u ? costs[child >> 1u].w : 0u;
        uint size = (child & 1u) == 0u ? forest_size(child_split, parts[i]) : 1u;
        if (size == 1u) {
            ++i;
        } else {
            children[i] = tree[2u * child].w;
            children[count] = tree[2u * children[i] + 1u].w;
            parts[i] = left_part(child_split, size);
            parts[count] = size - parts[i];
            ++count;
        }
    }

    NodeGrid grid =
        grid_over(bits_float(uvec3(tree[4u * node])), bits_float(uvec3(tree[4u * node + 1u])));
    uvec4 references = uvec4(lbvh_end);
    for (uint i = 0u; i < count; ++i) {
        uint child = children[i];
        add_child(grid, i, bits_float(uvec3(tree[2u * child])),
                  bits_float(uvec3(tree[2u * child + 1u])));
        references[i] = (child & 1u) == 0u ? 2u * (ranks[child >> 1u] - 1u) : child;
    }
    uint place = ranks[node] - 1u;
    write_grid(place, grid, count);
    nodes[4u * place + 3u] = references;
}
