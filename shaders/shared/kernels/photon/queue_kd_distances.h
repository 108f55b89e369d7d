// The level of the node that parts a leaf from the next one. What lies to the left of a node's
// right child has lower addresses.
FN uint parting_level(uint leaf) {
    uint node = 0u;
    uint level = 0u;
    for (; !kd_is_leaf(words[node]); ++level) {
        uint right = kd_right_child(words[node + 1u]);
        bool is_left = addresses[leaf] < right;
        if (is_left && addresses[leaf + 1u] >= right) {
            break;
        }
        node = is_left ? kd_left_child(node) : right;
    }
    return level;
}

// The distance of each cell from the next, as lbvh_fit reads it, where the cells are the leaves of
// a kd-tree, of which there are params.count. The root parts cells of caustic photons from the
// others.
FN void main() {
    uint cell = THREAD_INDEX;
    if (cell >= params.cells) {
        return;
    }
    uint leaves = params.caustic > 0u ? params.caustic : params.cells;
    uint leaf = cell < leaves ? cell : cell - leaves;
    uint distance = cell + 1u < params.cells ? kind_distance : no_neighbour;
    if (leaf + 1u < leaves) {
        // Behind the only leaf there may be an empty cell.
        distance = kind_distance - 1u - (leaf + 1u < params.count ? parting_level(leaf) : 0u);
    }
    distances[cell] = distance;
}
