// The planes that may split a large node of a level: one that cuts off empty space, or the middles
// of its sides. tight: the box of each node's elements.
FN void main() {
    uint k = THREAD_INDEX;
    if (params.first + k >= params.end) {
        return;
    }
    KdNode node = nodes[params.first + k];
    KdPlanes plan;
    plan.kind = kd_no_axis;
    vec3 split = vec3(real(0.0));
    if (node.count > kd_small && !kd_is_done(node.count, node.depth, params.rules)) {
        vec3 low = kd_low(cells[params.first + k]);
        vec3 high = kd_high(cells[params.first + k]);
        KdPlane cut =
            kd_cut(low, high, max(vec3(tight[2u * k]), low), min(vec3(tight[2u * k + 1u]), high));
        bool cuts = cut.axis != kd_no_axis;
        plan.kind = cuts ? cut.axis : kd_any_middle;
        split = cuts ? vec3(cut.split)
                     : vec3(kd_middle(low.x, high.x), kd_middle(low.y, high.y),
                            kd_middle(low.z, high.z));
    }
    plan.split_x = split.x;
    plan.split_y = split.y;
    plan.split_z = split.z;
    plans[k] = plan;
    for (uint j = 0u; j < 6u; ++j) {
        counts[6u * k + j] = 0u;
    }
}
