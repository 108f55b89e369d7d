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
        KdNode child = kd_child(node, choice, c == 0u);
        child.count = c == 0u ? choice.left : choice.right;
        if (child.count > kd_small) {
            child.first = next;
            next += child.count;
        } else {
            child.first = finished;
            child.bits = kd_bits_of(child.count);
            finished += child.count;
        }
        nodes[left + c] = child;
    }
}
