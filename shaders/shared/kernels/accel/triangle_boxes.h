// The bounding box of each triangle.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count.number) {
        return;
    }
    uvec3 vertices = uvec3(triangles[i]);
    vec3 a = vec3(positions[vertices.x]);
    vec3 b = vec3(positions[vertices.y]);
    vec3 c = vec3(positions[vertices.z]);
    boxes[2u * i] = vec4(min(min(a, b), c), real(0.0));
    boxes[2u * i + 1u] = vec4(max(max(a, b), c), real(0.0));
}
