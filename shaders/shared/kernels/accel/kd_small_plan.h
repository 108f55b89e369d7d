FN vec3 low_of(uint element) { return bits_float(uvec3(elements[lanes * element])); }
FN vec3 high_of(uint element) { return bits_float(uvec3(elements[lanes * element + lanes - 1u])); }

// The best of the candidates of a small node. Its elements on either side are those of its root
// that it has, too.
FN KdChoice best_choice(IN(KdNode) node, IN(BoxRecord) cell) {
    KdChoice best;
    best.axis = kd_no_axis;
    best.split = real(0.0);
    best.left = 0u;
    best.right = 0u;
    KdSpace space = kd_space(kd_low(cell), kd_high(cell), params.rules);
    real least = kd_cost_to_beat(space, node.count, params.rules);
    uint candidates = kd_candidates(params.rules);
    for (uint e = 0u; e < kd_small; ++e) {
        if ((node.bits & 1u << e) == 0u) {
            continue;
        }
        uint element = finished[node.first + e];
        for (uint c = 0u; c < candidates; ++c) {
            KdPlane plane = kd_candidate(c, low_of(element), high_of(element), params.rules);
            uint left = left_masks[(node.first + e) * candidates + c] & node.bits;
            uint right = right_masks[(node.first + e) * candidates + c] & node.bits;
            uint lefts = kd_bit_count(left);
            uint rights = kd_bit_count(right);
            if (kd_is_candidate(space, plane, lefts, rights, params.rules)) {
                real cost = kd_plane_cost(space, plane, node.count, lefts, rights, params.rules);
                if (cost < least) {
                    least = cost;
                    best.axis = plane.axis;
                    best.split = plane.split;
                    best.left = left;
                    best.right = right;
                }
            }
        }
    }
    return best;
}

// Finds the planes of a level's small nodes, and counts how the tree grows by them.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    KdNode node = nodes[active_nodes[i]];
    KdChoice choice;
    choice.axis = kd_no_axis;
    choice.split = real(0.0);
    choice.left = 0u;
    choice.right = 0u;
    if (!kd_is_done(node.count, node.depth, params.rules)) {
        choice = best_choice(node, cells[active_nodes[i]]);
    }
    choices[i] = choice;
    bool splits = choice.axis != kd_no_axis;
    split_counts[i] = splits ? 1u : 0u;
    if (splits) {
        atomicAdd(counters[kd_splits], 1u);
        atomicAdd(counters[kd_growth],
                  kd_bit_count(choice.left) + kd_bit_count(choice.right) - node.count);
    }
}
