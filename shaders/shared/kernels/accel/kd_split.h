// Writes the children of a level's large nodes. A node that is not split keeps its references, in
// their last place.
FN void main() {
    uint k = THREAD_INDEX;
    if (params.first + k >= params.end) {
        return;
    }
    KdNode node = nodes[params.first + k];
    uint next = next_sums[k];
    uint finished = params.finished + finished_sums[k];
    KdChoice choice = choices[k];
    if (choice.axis == kd_no_axis) {
        if (node.count > kd_small) {
            nodes[params.first + k].first = finished;
        }
        return;
    }
    uint left = params.nodes + 2u * split_sums[k];
    nodes[params.first + k].axis = choice.axis;
    nodes[params.first + k].split = choice.split;
    nodes[params.first + k].left = left;
    for (uint c = 0u; c < 2u; ++c) {
        uint count = c == 0u ? choice.left : choice.right;
        bool is_large = count > kd_small;
        nodes[left + c] = kd_leaf_node(is_large ? next : finished, count,
                                       is_large ? 0u : kd_bits_of(count), node.depth + 1u);
        cells[left + c] = kd_part_of(cells[params.first + k], choice, c == 0u);
        next += is_large ? count : 0u;
        finished += is_large ? 0u : count;
    }
}
