// Reading ForestCost::split. A forest's size is how many nodes of the four-wide tree may stand for
// a node of the binary tree; a node that is one of them itself has the size 1, and its children
// share four.
FN uint forest_size(uint split, uint allowed) {
    return allowed == 1u ? 1u : (allowed == 2u ? (split >> 2u) & 3u : (split >> 4u) & 3u);
}

// What the left child of a node may have of the node's forest of this size.
FN uint left_part(uint split, uint size) {
    return size == 1u ? split & 3u : (size == 2u ? 1u : (split >> 6u) & 3u);
}

FN uint child_part(uint split, uint size, bool right) {
    uint left = left_part(split, size);
    return right ? (size == 1u ? 4u : size) - left : left;
}
