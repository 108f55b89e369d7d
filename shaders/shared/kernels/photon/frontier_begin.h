// Makes the root, of params.end queries and of the photons that are flagged among params.first.
FN void main() {
    if (THREAD_INDEX > 0u) {
        return;
    }
    uint last = params.first - 1u;
    uint photons = sums[last] + flags[last];
    uint state = frontier_state(params.end, photons, boxes[0], params);
    bool is_active = state == frontier_active;
    ranges[0] = SegmentRange(0u, params.end);
    nodes[0] = FrontierNode(0u, photons, state, 0u);
    counters[frontier_references] = photons;
    counters[frontier_parents] = is_active ? 1u : 0u;
    counters[frontier_chunks] = is_active ? chunks_of(photons, params.chunk) : 0u;
    counters[frontier_most] = state == frontier_leaf ? ~photons : 0xffffffffu;
}
