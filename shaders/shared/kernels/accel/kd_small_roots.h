// Flags the small nodes that may be split.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    uint count = nodes[i].count;
    bool may_split = nodes[i].axis == kd_no_axis && count <= kd_small &&
                     !kd_is_done(count, nodes[i].depth, params.rules);
    flags[i] = may_split ? 1u : 0u;
    values[i] = i;
}
