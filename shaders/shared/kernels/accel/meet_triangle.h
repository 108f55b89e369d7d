// Rays and opaque triangles. TRIANGLES(i) reads them.

FN bool meet_triangle(Ray ray, uint place, INOUT(HitRecord) hit) {
    vec4 a = TRIANGLES(place);
    vec3 b = vec3(TRIANGLES(place + 1u));
    vec3 c = vec3(TRIANGLES(place + 2u));
    real t, u, v;
    bool met = intersect_triangle(ray.shear, ray.origin, vec3(a), b, c, real(0.0), hit.t, t, u, v);
    if (met) {
        // Of triangles at the same distance the first in the scene counts, independent of the order
        // of traversal.
        uint triangle = float_bits(a.w);
        if (t < hit.t || triangle < hit.triangle) {
            hit = HitRecord(triangle, t, u, v);
        }
    }
    return met;
}
