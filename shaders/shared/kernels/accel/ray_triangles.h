// Copies the triangles' vertices into the order of the leaves.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count.number) {
        return;
    }
    uint triangle = order[i];
    uvec3 vertices = uvec3(triangles[triangle]);
    leaf_triangles[3u * i] = vec4(vec3(positions[vertices.x]), bits_float(triangle));
    leaf_triangles[3u * i + 1u] = vec4(vec3(positions[vertices.y]), real(0.0));
    leaf_triangles[3u * i + 2u] = vec4(vec3(positions[vertices.z]), real(0.0));
}
