// Finds the largest subtree of at most leaf_size photons around each photon; the first photon of a
// subtree is its head. These subtrees are the leaves that remain when splits below the threshold
// are undone (Fabianowski and Dingliana 2009, §6.2), so their number is known before the tree is
// built.
FN void main() {
    uint i = THREAD_INDEX;
    uint stored = counters[counter_stored];
    if (i >= stored) {
        return;
    }
    uint first = i;
    uint last = i;
    for (;;) {
        uint before = first > 0u ? distances[first - 1u] : no_neighbour;
        uint after = distances[last];
        uint split = min(before, after);
        // The root separates caustic photons from others; no leaf contains both.
        if (split >= kind_distance) {
            break;
        }
        // The parent extends as far as the distances between neighbours do not exceed that between
        // its children.
        uint parent_first = first;
        uint parent_last = last;
        while (parent_last - parent_first < params.leaf_size && distances[parent_last] <= split) {
            ++parent_last;
        }
        while (parent_last - parent_first < params.leaf_size && parent_first > 0u &&
               distances[parent_first - 1u] <= split) {
            --parent_first;
        }
        if (parent_last - parent_first >= params.leaf_size) {
            break;
        }
        first = parent_first;
        last = parent_last;
    }
    leaves[i] = first | ((last - first) << leaf_first_bits);
    heads[i] = first == i ? 1u : 0u;
}
