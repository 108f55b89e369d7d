// Reads ForestCost::split. The size of a forest is the number of four-wide nodes that may represent
// a node of the binary tree. A node that itself becomes a four-wide node has size 1, and its
// children share four.
FN uint forest_size(uint split, uint allowed) {
    return allowed == 1u ? 1u : (allowed == 2u ? (split >> 2u) & 3u : (split >> 4u) & 3u);
}

// How many nodes of a forest of this size the left child may have.
FN uint left_part(uint split, uint size) {
    return size == 1u ? split & 3u : (size == 2u ? 1u : (split >> 6u) & 3u);
}

FN uint child_part(uint split, uint size, bool right) {
    uint left = left_part(split, size);
    return right ? (size == 1u ? 4u : size) - left : left;
}
