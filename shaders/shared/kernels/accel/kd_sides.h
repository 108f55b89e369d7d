// Flags the references that go to the left and to the right child of their node.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    KdChoice choice = choices[segments[i]];
    vec3 low = bits_float(uvec3(references[lanes * i]));
    vec3 high = bits_float(uvec3(references[lanes * i + lanes - 1u]));
    bool splits = choice.axis != kd_no_axis;
    lefts[i] = splits && kd_is_left(kd_at(low, choice.axis), choice.split) ? 1u : 0u;
    rights[i] = splits && kd_is_right(kd_at(high, choice.axis), choice.split) ? 1u : 0u;
}
