// Writes the children of a level's small nodes, which are the nodes of the next level.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    KdChoice choice = choices[i];
    if (choice.axis == kd_no_axis) {
        return;
    }
    uint at = active_nodes[i];
    KdNode node = nodes[at];
    uint place = 2u * split_sums[i];
    nodes[at].axis = choice.axis;
    nodes[at].split = choice.split;
    nodes[at].left = params.nodes + place;
    for (uint c = 0u; c < 2u; ++c) {
        uint bits = c == 0u ? choice.left : choice.right;
        uint child = params.nodes + place + c;
        nodes[child] = kd_leaf_node(node.first, kd_bit_count(bits), bits, node.depth + 1u);
        cells[child] = kd_part_of(cells[at], choice, c == 0u);
        next_nodes[place + c] = child;
    }
}
