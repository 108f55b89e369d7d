// Moves a reference to a child: place j of a large one, or into the finished ones.
FN void move(uint i, uint child, uint j) {
    KdNode node = nodes[child];
    uvec4 reference = references[lanes * i];
    uint to = node.first + j;
    if (node.count > kd_small) {
        next_references[lanes * to] = reference;
        if (lanes == 2u) {
            next_references[2u * to + 1u] = references[2u * i + 1u];
        }
        next_segments[to] = child - params.nodes;
    } else {
        finished[to] = reference.w;
        finished_nodes[to] = no_segment;
    }
}

// Moves the references of a level to the children, or to the finished ones. Each keeps its order.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    uint k = segments[i];
    KdNode node = nodes[params.first + k];
    uint first = starts[k];
    if (node.axis == kd_no_axis) {
        uint to = node.first + (i - first);
        finished[to] = references[lanes * i].w;
        finished_nodes[to] = params.first + k;
        return;
    }
    if (lefts[i] != 0u) {
        move(i, node.left, left_sums[i] - left_sums[first]);
    }
    if (rights[i] != 0u) {
        move(i, node.left + 1u, right_sums[i] - right_sums[first]);
    }
}
