// Finds the box of a part of a moving caster, where its vertices are now.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.parts) {
        return;
    }
    CasterPart part = parts[i];
    vec3 low = vec3(positions[vertices[part.first]]);
    vec3 high = low;
    for (uint k = 1u; k < part.count; ++k) {
        vec3 position = vec3(positions[vertices[part.first + k]]);
        low = min(low, position);
        high = max(high, position);
    }
    boxes[i] = BoxRecord(low.x, low.y, low.z, real(0.0), high.x, high.y, high.z, real(0.0));
}
