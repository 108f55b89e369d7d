FN KdChoice choice_of(uint k, uint axis, real split) {
    KdChoice choice;
    choice.axis = axis;
    choice.split = split;
    choice.left = counts[6u * k + axis];
    choice.right = counts[6u * k + 3u + axis];
    return choice;
}

// The plane of a large node: one that cuts off empty space, or else the middle of the longest side,
// or of the next one if the elements on both sides would cost as much as all of them.
FN KdChoice decide(uint k, IN(KdNode) node, IN(KdPlanes) plan) {
    vec3 split = vec3(plan.split_x, plan.split_y, plan.split_z);
    if (plan.kind < kd_no_axis) {
        return choice_of(k, plan.kind, kd_at(split, plan.kind));
    }
    vec3 low = kd_low(cells[params.first + k]);
    vec3 high = kd_high(cells[params.first + k]);
    KdSpace space = kd_space(low, high, params.rules);
    KdChoice none;
    none.axis = kd_no_axis;
    none.split = real(0.0);
    none.left = 0u;
    none.right = 0u;
    for (uint j = 0u; j < 3u; ++j) {
        uint axis = kd_longest(high - low, j);
        KdChoice choice = choice_of(k, axis, kd_at(split, axis));
        KdPlane plane;
        plane.axis = axis;
        plane.split = choice.split;
        if (kd_is_candidate(space, plane, choice.left, choice.right, params.rules) &&
            kd_plane_cost(space, plane, node.count, choice.left, choice.right, params.rules) <
                kd_cost_to_beat(space, node.count, params.rules)) {
            return choice;
        }
    }
    return none;
}

// Decides on the large nodes of a level, and counts the references of their children.
FN void main() {
    uint k = THREAD_INDEX;
    if (params.first + k >= params.end) {
        return;
    }
    KdNode node = nodes[params.first + k];
    KdPlanes plan = plans[k];
    KdChoice choice;
    choice.axis = kd_no_axis;
    choice.split = real(0.0);
    choice.left = 0u;
    choice.right = 0u;
    if (params.stop == 0u && plan.kind != kd_no_axis) {
        choice = decide(k, node, plan);
    }
    choices[k] = choice;
    bool splits = choice.axis != kd_no_axis;
    uint next =
        (choice.left > kd_small ? choice.left : 0u) + (choice.right > kd_small ? choice.right : 0u);
    uint all = splits ? choice.left + choice.right : node.count > kd_small ? node.count : 0u;
    starts[k] = node.first;
    split_counts[k] = splits ? 1u : 0u;
    next_counts[k] = next;
    finished_counts[k] = all - next;
    if (splits) {
        atomicAdd(counters[kd_splits], 1u);
        atomicAdd(counters[kd_growth], all - node.count);
        atomicAdd(counters[kd_next], next);
    }
    atomicAdd(counters[kd_finished], all - next);
}
