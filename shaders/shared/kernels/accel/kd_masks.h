FN vec3 low_of(uint element) { return bits_float(uvec3(elements[lanes * element])); }
FN vec3 high_of(uint element) { return bits_float(uvec3(elements[lanes * element + lanes - 1u])); }

// For each candidate of an element of a small node: the bits of the elements on either side.
FN void main() {
    uint root = params.first + THREAD_INDEX / kd_small;
    uint e = THREAD_INDEX % kd_small;
    if (root >= params.end) {
        return;
    }
    KdNode node = nodes[active_nodes[root]];
    if (e >= node.count) {
        return;
    }
    uint own = finished[node.first + e];
    uint candidates = kd_candidates(params.rules);
    KdPlane planes[6];
    uvec2 sides[6];
    for (uint c = 0u; c < candidates; ++c) {
        planes[c] = kd_candidate(c, low_of(own), high_of(own), params.rules);
        sides[c] = uvec2(0u);
    }
    for (uint j = 0u; j < node.count; ++j) {
        uint element = finished[node.first + j];
        vec3 low = low_of(element);
        vec3 high = high_of(element);
        for (uint c = 0u; c < candidates; ++c) {
            bool left = kd_is_left(kd_at(low, planes[c].axis), planes[c].split);
            bool right = kd_is_right(kd_at(high, planes[c].axis), planes[c].split);
            sides[c] |= uvec2(left ? 1u << j : 0u, right ? 1u << j : 0u);
        }
    }
    for (uint c = 0u; c < candidates; ++c) {
        left_masks[(node.first + e) * candidates + c] = sides[c].x;
        right_masks[(node.first + e) * candidates + c] = sides[c].y;
    }
}
