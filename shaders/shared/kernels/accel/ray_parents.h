// Writes for each child of a node where its box is: 4 times the node, plus the child's number.
FN void main() {
    uint node = THREAD_INDEX;
    if (node >= node_count[0]) {
        return;
    }
    uint count = nodes[4u * node].w >> 24u;
    uvec4 references = nodes[4u * node + 3u];
    for (uint i = 0u; i < count; ++i) {
        parents[references[i]] = 4u * node + i;
    }
}
