// Sums up the leaves below the nodes of a level, and their references, after those of the children.
FN void main() {
    uint i = params.first + THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    if (nodes[i].axis == kd_no_axis) {
        return;
    }
    uint left = nodes[i].left;
    nodes[i].leaves = nodes[left].leaves + nodes[left + 1u].leaves;
    nodes[i].count = nodes[left].count + nodes[left + 1u].count;
}
