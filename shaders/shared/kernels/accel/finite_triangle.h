// Corners of a triangle. If one is not finite, all are the same point: no ray hits such a triangle,
// whatever a device's min and max return for NaN.
struct Corners {
    vec3 a, b, c;
};

FN Corners finite_triangle(uvec4 vertices) {
    Corners corners;
    corners.a = vec3(positions[vertices.x]);
    corners.b = vec3(positions[vertices.y]);
    corners.c = vec3(positions[vertices.z]);
    bool a = is_finite3(corners.a);
    bool b = is_finite3(corners.b);
    bool c = is_finite3(corners.c);
    if (!(a && b && c)) {
        vec3 point = a ? corners.a : b ? corners.b : c ? corners.c : vec3(real(0.0));
        corners.a = point;
        corners.b = point;
        corners.c = point;
    }
    return corners;
}
