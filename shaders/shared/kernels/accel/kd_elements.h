// The elements, whose coordinates follow the rules: all of them are in the root, segment 0.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    vec3 low = kd_position(vec3(boxes[2u * i]));
    vec3 high = max(low, kd_position(vec3(boxes[2u * i + 1u])));
    elements[lanes * i] = uvec4(float_bits(low), i);
    if (lanes == 2u) {
        elements[2u * i + 1u] = uvec4(float_bits(high), 0u);
    }
    segments[i] = 0u;
    finished[i] = i;
    finished_nodes[i] = no_segment;
}
