// Finds the box of the posed vertices of a part of a moving mesh.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.parts) {
        return;
    }
    PosePart part = parts[i];
    vec3 low = vec3(bits_float(0x7f800000u)); // infinity: an empty box
    vec3 high = -low;
    uint not_finite = 0u;
    for (uint k = 0u; k < part.vertices; ++k) {
        vec3 position = vec3(positions[part.first_vertex + k]);
        if (!is_finite3(position)) {
            not_finite += 1u;
        } else if (vertices[part.first_moving_vertex + k].is_used != 0u) {
            low = min(low, position);
            high = max(high, position);
        }
    }
    boxes[i] = PoseBox(low.x, low.y, low.z, not_finite, high.x, high.y, high.z, 0u);
}
