#include "shared/kernels/accel/forest.h"

// ranks: inclusive sums of the flags written by wide_roots.
FN bool is_wide(uint node) { return ranks[node] != (node > 0u ? ranks[node - 1u] : 0u); }

// Biased exponent of the least power of two such that `cells` cells of that size cover the extent.
FN uint cell_exponent(real extent) {
    uint bits = float_bits(max(extent, real(0.0)) / real(255.0));
    return clamp((bits + 0x7fffffu) >> 23u, 1u, 254u);
}

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

    vec3 low = bits_float(uvec3(tree[4u * node]));
    vec3 high = bits_float(uvec3(tree[4u * node + 1u]));
    uvec3 exponents = uvec3(cell_exponent(high.x - low.x), cell_exponent(high.y - low.y),
                            cell_exponent(high.z - low.z));
    vec3 cell = bits_float(exponents << 23u);
    uvec3 low_cells = uvec3(0u);
    uvec3 high_cells = uvec3(0u);
    uvec4 references = uvec4(lbvh_end);
    for (uint i = 0u; i < count; ++i) {
        uint child = children[i];
        vec3 child_low = bits_float(uvec3(tree[2u * child]));
        vec3 child_high = bits_float(uvec3(tree[2u * child + 1u]));
        low_cells |= uvec3(clamp(floor((child_low - low) / cell), real(0.0), real(255.0)))
                     << (8u * i);
        high_cells |= uvec3(clamp(ceil((child_high - low) / cell), real(0.0), real(255.0)))
                      << (8u * i);
        references[i] = (child & 1u) == 0u ? 2u * (ranks[child >> 1u] - 1u) : child;
    }
    uint place = 4u * (ranks[node] - 1u);
    nodes[place] = uvec4(float_bits(low),
                         exponents.x | (exponents.y << 8u) | (exponents.z << 16u) | (count << 24u));
    nodes[place + 1u] = uvec4(low_cells, high_cells.x);
    nodes[place + 2u] = uvec4(high_cells.y, high_cells.z, 0u, 0u);
    nodes[place + 3u] = references;
}
