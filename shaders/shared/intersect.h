// Rays against triangles, and points on triangles, with bounds of the rounding errors: no
// scene-wide epsilon. All of it is the same at any scale, as long as products of two lengths
// neither over- nor underflow.
#ifndef ARGAND_SHARED_INTERSECT_H
#define ARGAND_SHARED_INTERSECT_H

#include "shared/maths.h"

#ifdef ARGAND_REAL_DOUBLE
#include <limits>
#endif

ARGAND_SHARED_BEGIN

#ifdef ARGAND_REAL_DOUBLE
CONSTANT real HALF_ULP = real(1.1102230246251565e-16);
#else
CONSTANT real HALF_ULP = real(5.9604644775390625e-8);
#endif

// Bound of the relative error of n roundings, slightly above Higham's gamma(n) = n u / (1 - n u).
FN real error_bound(int n) { return real(n) * HALF_ULP * real(1.000001); }

// Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection": the axis along which the
// direction is longest becomes z, and the ray is sheared on it.
struct RayShear {
    uint axis;
    real x, y, z; // shear along x and y, and 1 / the direction's z
};

// The component of v along the axis last, the others behind it in cyclic order.
FN vec3 axis_last(uint axis, vec3 v) {
    return axis == 0u ? vec3(v.y, v.z, v.x) : (axis == 1u ? vec3(v.z, v.x, v.y) : v);
}

// direction: not zero, of any length.
FN RayShear ray_shear(vec3 direction) {
    vec3 size = abs(direction);
    RayShear shear;
    shear.axis = size.x > size.y ? (size.x > size.z ? 0u : 2u) : (size.y > size.z ? 1u : 2u);
    vec3 d = axis_last(shear.axis, direction);
    shear.x = d.x / d.z;
    shear.y = d.y / d.z;
    shear.z = real(1.0) / d.z;
    return shear;
}

// Whether the ray meets the triangle at a t of [tmin, tmax], from either side; t counts lengths of
// the direction, and u and v are the barycentric weights of v1 and v2.
//
// Rounding is monotonic, so the edge functions below, differences of two products of the sheared
// coordinates, are zero or have the right sign, and for an edge that two triangles share they are
// each other's negatives. Zero counts as inside: on a shared edge or vertex at least one triangle
// is hit, often several at about one t. Seen edge-on (all edge functions zero) a triangle is
// missed.
FN bool intersect_triangle(IN(RayShear) shear, vec3 origin, vec3 v0, vec3 v1, vec3 v2, real tmin,
                           real tmax, OUT(real) t, OUT(real) u, OUT(real) v) {
    vec3 a = axis_last(shear.axis, v0 - origin);
    vec3 b = axis_last(shear.axis, v1 - origin);
    vec3 c = axis_last(shear.axis, v2 - origin);
    real ax = a.x - shear.x * a.z;
    real ay = a.y - shear.y * a.z;
    real bx = b.x - shear.x * b.z;
    real by = b.y - shear.y * b.z;
    real cx = c.x - shear.x * c.z;
    real cy = c.y - shear.y * c.z;
    real ea = cx * by - cy * bx;
    real eb = ax * cy - ay * cx;
    real ec = bx * ay - by * ax;
    real determinant = ea + eb + ec;
    t = real(0.0);
    u = real(0.0);
    v = real(0.0);
    bool inside = min(ea, min(eb, ec)) >= real(0.0) || max(ea, max(eb, ec)) <= real(0.0);
    if (!inside || determinant == real(0.0)) {
        return false;
    }
    // All three have the determinant's sign and at most its size: nothing overflows.
    u = eb / determinant;
    v = ec / determinant;
    t = ((ea / determinant) * a.z + u * b.z + v * c.z) * shear.z;
    return t >= tmin && t <= tmax;
}

// The furthest, along any axis, that a vertex in the box is from the origin: that of the whole
// scene serves every ray.
FN real box_reach(vec3 origin, vec3 low, vec3 high) {
    return max_component(max(abs(low - origin), abs(high - origin)));
}

// Point of a triangle with the weights u, v of its second and third vertex, and a bound of how far
// along any axis rounding takes it, or what a later intersection makes of it, from the triangle's
// plane. Placing the point takes less (Pharr, Jakob and Humphreys, "Physically Based Rendering",
// section 3.9: gamma(7) of the weighted coordinates); but the distances that intersect_triangle
// finds from there err by some roundings of the triangle's largest coordinate, in whichever
// direction: a floor at height 0 has no error of its own, and yet rays that start on it would meet
// it.
FN vec3 hit_point(vec3 v0, vec3 v1, vec3 v2, real u, real v, OUT(vec3) error) {
    error = vec3(max_component(max(abs(v0), max(abs(v1), abs(v2)))) * error_bound(16));
    return v0 * (real(1.0) - u - v) + v1 * u + v2 * v;
}

// The next number from x towards +infinity (up) or -infinity.
FN real next_real(real x, bool up) {
#ifdef ARGAND_REAL_DOUBLE
    return std::nextafter(x, up ? std::numeric_limits<real>::infinity()
                                : -std::numeric_limits<real>::infinity());
#else
    if (!is_finite(x)) {
        return x;
    }
    if (x == real(0.0)) {
        return bits_float(up ? 0x00000001u : 0x80000001u);
    }
    uint bits = float_bits(x);
    return bits_float((x > real(0.0)) == up ? bits + 1u : bits - 1u);
#endif
}

// Origin of a ray that leaves the surface at p along w: moved along the unit normal n of the
// triangle by the error's bound, to the side that w goes to, at any scale. Each coordinate is
// rounded away from p, lest the sum's rounding undo the move. Needles (more than 30 times as long
// as high) are the exception: of rays that leave them about one in a hundred still meets its own
// triangle; a traversal that leaves out the triangle a ray starts on is free of that.
FN vec3 offset_ray_origin(vec3 p, vec3 error, vec3 n, vec3 w) {
    vec3 offset = n * dot3(abs(n), error);
    offset = dot3(w, n) < real(0.0) ? -offset : offset;
    vec3 o = p + offset;
    return vec3(offset.x == real(0.0) ? o.x : next_real(o.x, offset.x > real(0.0)),
                offset.y == real(0.0) ? o.y : next_real(o.y, offset.y > real(0.0)),
                offset.z == real(0.0) ? o.z : next_real(o.z, offset.z > real(0.0)));
}

ARGAND_SHARED_END

#endif
