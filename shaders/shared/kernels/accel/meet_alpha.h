// Rays and triangles that may be partly absent. TRIANGLES(i) reads them, corners[i] their vertices
// and materials.
#include "shared/kernels/alpha.h"

// Before all hits.
FN HitRecord nothing_passed() { return HitRecord(0u, -real(1.0), real(0.0), real(0.0)); }

FN bool is_on_edge(HitRecord hit) {
    return hit.u == real(0.0) || hit.v == real(0.0) || hit.u + hit.v >= real(1.0) - error_bound(4);
}

// Intersects the ray with a triangle at no more than hit.t. Returns how much of the surface it
// meets, or -1: nothing. A ray through an edge between two triangles meets one of them, unless the
// surface is opaque: there no ray may slip through.
FN real meet_coverage(Ray ray, uint place, INOUT(HitRecord) hit) {
    vec4 a = TRIANGLES(place);
    vec3 b = vec3(TRIANGLES(place + 1u));
    vec3 c = vec3(TRIANGLES(place + 2u));
    real t, u, v;
    if (!intersect_triangle(ray.shear, ray.origin, vec3(a), b, c, real(0.0), hit.t, t, u, v)) {
        return -real(1.0);
    }
    hit = HitRecord(float_bits(a.w), t, u, v);
    uvec4 triangle = corners[hit.triangle];
    real coverage = coverage_at(triangle, vec2(u, v));
    if (coverage >= real(1.0)) {
        return coverage;
    }
    if (is_absent(triangle, coverage) ||
        (is_on_edge(hit) && !crosses_triangle(ray.shear, ray.origin, vec3(a), b, c))) {
        return -real(1.0);
    }
    return coverage;
}

FN void load_passed(uint from, OUT(HitRecord) passed) {
    passed = HitRecord(suspended[from], bits_float(suspended[from + 1u]), real(0.0), real(0.0));
}

FN void store_passed(uint to, HitRecord passed) {
    suspended[to] = passed.triangle;
    suspended[to + 1u] = float_bits(passed.t);
}

// Finds a hit between `passed` and `hit`. Returns whether an opaque surface is there.
FN bool meet_triangle(Ray ray, uint place, HitRecord passed, INOUT(HitRecord) hit) {
    HitRecord candidate = hit;
    real coverage = meet_coverage(ray, place, candidate);
    if (coverage < real(0.0) || !comes_before(passed, candidate) || !comes_before(candidate, hit)) {
        return false;
    }
    hit = candidate;
    return coverage >= real(1.0);
}

// Adds to the thickness in `hit.triangle` that of any surface up to hit.t. Returns whether no light
// passes.
FN bool pass_triangle(Ray ray, uint place, INOUT(HitRecord) hit) {
    HitRecord candidate = hit;
    real coverage = meet_coverage(ray, place, candidate);
    if (coverage < real(0.0)) {
        return false;
    }
    hit.triangle = add_thickness(hit.triangle, thickness_of(coverage));
    return hit.triangle == thickness_of_all;
}
