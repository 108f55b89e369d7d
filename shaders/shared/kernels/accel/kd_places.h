// Finds where the children of a level's nodes are written, after these themselves.
FN void main() {
    uint i = params.first + THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    if (i == 0u) {
        KdPlace root;
        root.address = 0u;
        root.leaf = 0u;
        root.parent = 0u;
        root.pad0 = 0u;
        places[0] = root;
    }
    if (nodes[i].axis == kd_no_axis) {
        return;
    }
    uint left = nodes[i].left;
    uint leaves = nodes[left].leaves;
    KdPlace place = places[i];
    place.address += kd_parent_words;
    place.parent += 1u;
    places[left] = place;
    place.address += kd_parent_words * (leaves - 1u) + kd_leaf_words * leaves + nodes[left].count;
    place.leaf += leaves;
    place.parent += leaves - 1u;
    places[left + 1u] = place;
}
