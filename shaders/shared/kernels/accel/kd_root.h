// The root of the tree, whose cell ends just above its elements. boxes[0]: of all elements.
FN void main() {
    if (THREAD_INDEX > 0u) {
        return;
    }
    bool is_empty = params.end == 0u;
    vec3 low = is_empty ? vec3(real(0.0)) : vec3(boxes[0]);
    vec3 high = kd_just_above(is_empty ? vec3(real(0.0)) : vec3(boxes[1]));
    uint bits = params.end <= kd_small ? kd_bits_of(params.end) : 0u;
    nodes[0] = kd_leaf_node(0u, params.end, bits, 0u);
    cells[0] = kd_cell(low, high);
}
