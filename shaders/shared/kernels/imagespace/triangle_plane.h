// The plane of a triangle: its first vertex, and its normal, a unit vector on the side from which
// the vertices run counter-clockwise; (0,0,0) if it has no area.
struct TrianglePlane {
    vec3 corner, normal;
};

FN TrianglePlane triangle_plane(uint triangle) {
    uvec4 t = triangles[triangle];
    TrianglePlane plane;
    plane.corner = vec3(positions[t.x]);
    real size;
    plane.normal = unit_and_length(
        cross3(vec3(positions[t.y]) - plane.corner, vec3(positions[t.z]) - plane.corner), size);
    return plane;
}
