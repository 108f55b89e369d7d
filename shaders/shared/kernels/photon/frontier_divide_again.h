// The parts of parts of nodes: one if they are not partitioned again. Counts those that are.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    bool again = is_partitioned(ranges[i].count, boxes[i], params);
    copies[i] = again ? 2u : 1u;
    if (again) {
        atomicAdd(counters[frontier_parents], 1u);
    }
}
