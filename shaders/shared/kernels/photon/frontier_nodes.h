// Makes the children of a level's nodes: counts their references, and decides what becomes of them.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    uint parent = ancestors[i];
    uint chunks = chunks_of(nodes[parent].count, params.chunk);
    uint at = most_frontier_children * first_chunks[parent] + (i - families[2u * parent]) * chunks;
    uint first = sums[at];
    uint end = sums[at + chunks - 1u] + counts[at + chunks - 1u];
    uint state = frontier_state(ranges[i].count, end - first, boxes[i], params);
    next_nodes[i] = FrontierNode(first, end - first, state, 0u);
    if (state == frontier_active) {
        atomicAdd(counters[frontier_parents], 1u);
        atomicAdd(counters[frontier_chunks], chunks_of(end - first, params.chunk));
    } else if (state == frontier_leaf) {
        atomicMin(counters[frontier_most], ~(end - first));
    }
    if (i + 1u == params.end) {
        counters[frontier_references] = end;
    }
}
