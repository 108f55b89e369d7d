// Hangs further leaves behind the leaf of a cell that holds more records than a leaf may: a walk
// goes from one to the next by its escape. The nodes of further leaves lie behind those of all
// cells.
FN void main() {
    uint cell = THREAD_INDEX;
    if (cell >= params.cells) {
        return;
    }
    uint first = starts[cell];
    uint count = starts[cell + 1u] - first;
    if (count <= most_photons_a_leaf) {
        return;
    }
    uint node = 2u * cell + 1u;
    uvec4 low = nodes[2u * node];
    uvec4 high = nodes[2u * node + 1u];
    uint escape = high.w;
    uint next = 2u * (params.cells + chains[cell]) + 1u;
    uint chain = (count - 1u) / most_photons_a_leaf;
    nodes[2u * node + 1u].w = next;
    for (uint i = 1u; i <= chain; ++i) {
        uint begin = i * most_photons_a_leaf;
        uint in_leaf = min(count - begin, most_photons_a_leaf);
        low.w = (first + begin) | ((in_leaf - 1u) << leaf_first_bits);
        high.w = i < chain ? next + 2u : escape;
        nodes[2u * next] = low;
        nodes[2u * next + 1u] = high;
        next += 2u;
    }
}
