// Writes a node of the tree. The elements of large leaves are left to kd_write_large.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    KdNode node = nodes[i];
    KdPlace place = places[i];
    bool is_leaf = node.axis == kd_no_axis;
    uint index = is_leaf ? place.leaf : params.leaf_count + place.parent;
    uint at = place.address;
    addresses[index] = at;
    boxes[index] = cells[i];
    if (!is_leaf) {
        words[at] = index;
        words[at + 1u] = kd_parent_word(node.axis, places[node.left + 1u].address);
        words[at + 2u] = float_bits(node.split);
        return;
    }
    words[at] = index | kd_leaf;
    words[at + 1u] = node.count;
    at += kd_leaf_words;
    for (uint e = 0u; e < kd_small && node.count <= kd_small; ++e) {
        if ((node.bits & 1u << e) != 0u) {
            words[at] = finished[node.first + e];
            at += 1u;
        }
    }
}
