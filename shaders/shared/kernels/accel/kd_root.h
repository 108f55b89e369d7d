// The root of the tree, whose cell ends just above its elements. boxes[0]: of all elements.
FN void main() {
    if (THREAD_INDEX > 0u) {
        return;
    }
    bool is_empty = params.end == 0u;
    vec3 low = is_empty ? vec3(real(0.0)) : vec3(boxes[0]);
    vec3 high = kd_just_above(is_empty ? vec3(real(0.0)) : vec3(boxes[1]));
    KdNode node;
    node.low_x = low.x;
    node.low_y = low.y;
    node.low_z = low.z;
    node.axis = kd_no_axis;
    node.high_x = high.x;
    node.high_y = high.y;
    node.high_z = high.z;
    node.split = real(0.0);
    node.first = 0u;
    node.count = params.end;
    node.bits = params.end <= kd_small ? kd_bits_of(params.end) : 0u;
    node.root = 0u;
    node.left = 0u;
    node.depth = 0u;
    node.leaves = 1u;
    node.references = 0u;
    nodes[0] = node;
}
