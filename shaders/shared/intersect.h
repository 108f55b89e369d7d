#ifndef ARGAND_SHARED_INTERSECT_H
#define ARGAND_SHARED_INTERSECT_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Point of a triangle at the weights u, v of its second and third vertex, and a bound of its absolute error, the same
// for all components: gamma(7) of the sum of the terms' sizes (Pharr et al., "Physically Based Rendering", 3rd ed.,
// §3.9). The largest component counts, not each its own, for a ray's test of a triangle mixes them: a floor at height 0
// is exactly there, and yet is met by a ray that starts on it.
FN vec3 hit_point(vec3 v0, vec3 v1, vec3 v2, real u, real v, OUT(vec3) error) {
    real w = real(1.0) - u - v;
    vec3 size = max(abs(v0), max(abs(v1), abs(v2)));
    error = vec3(max(size.x, max(size.y, size.z)) * real(16.0 * 5.9604645e-8));
    return v0 * w + v1 * u + v2 * v;
}

// The next number away from zero in the direction of `towards`.
FN real nudge(real x, real towards) {
#ifdef ARGAND_REAL_DOUBLE
    return x + (towards > real(0.0) ? abs(x) : -abs(x)) * real(1e-16);
#else
    if (towards == real(0.0) || x == real(0.0)) {
        return x;
    }
    uint bits = float_bits(x);
    return bits_float((towards > real(0.0)) == (x > real(0.0)) ? bits + 1u : bits - 1u);
#endif
}

// Origin of a ray that leaves the surface along w: moved along the normal by the bound of the point's error, and not
// further, so that it lies on the side it goes to whatever the scene's scale.
FN vec3 offset_ray_origin(vec3 p, vec3 error, vec3 normal, vec3 w) {
    real d = dot(abs(normal), error);
    vec3 offset = normal * d;
    offset = dot(w, normal) < real(0.0) ? -offset : offset;
    vec3 o = p + offset;
    return vec3(nudge(o.x, offset.x), nudge(o.y, offset.y), nudge(o.z, offset.z));
}

ARGAND_SHARED_END

#endif
