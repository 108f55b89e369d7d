// Intersects rays with triangles and computes points on triangles, with bounds of the rounding
// errors instead of a scene-wide epsilon. Results are the same at any scale as long as products of
// two lengths neither over- nor underflow.
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

// Shear of Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection": the axis along
// which the direction is longest becomes z, and the ray is sheared onto it.
struct RayShear {
    uint axis;
    real x, y, z; // shears along x and y, and 1 / the direction's z
};

// Rotates the components of v cyclically so that the one along the axis is last.
FN vec3 axis_last(uint axis, vec3 v) {
    return axis == 0u ? vec3(v.y, v.z, v.x) : (axis == 1u ? vec3(v.z, v.x, v.y) : v);
}

// The axis along which v is longest.
FN uint longest_axis(vec3 v) {
    vec3 size = abs(v);
    return size.x > size.y ? (size.x > size.z ? 0u : 2u) : (size.y > size.z ? 1u : 2u);
}

// direction: of any length but 0.
FN RayShear ray_shear(vec3 direction) {
    RayShear shear;
    shear.axis = longest_axis(direction);
    vec3 d = axis_last(shear.axis, direction);
    shear.x = d.x / d.z;
    shear.y = d.y / d.z;
    shear.z = real(1.0) / d.z;
    return shear;
}

// Whether the ray hits the triangle at a t in [tmin, tmax], from either side. t is in units of the
// direction's length; u and v are the barycentric weights of v1 and v2.
//
// Rounding is monotonic, so each edge function below, a difference of two products of sheared
// coordinates, is zero or has the right sign, and two triangles that share an edge compute negated
// values for it. Zero counts as inside: on a shared edge or vertex at least one triangle is hit,
// often several at nearly the same t. A triangle seen edge-on (all edge functions zero) is missed.
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
    // All three have the determinant's sign and at most its magnitude, so nothing overflows.
    u = eb / determinant;
    v = ec / determinant;
    t = ((ea / determinant) * a.z + u * b.z + v * c.z) * shear.z;
    return t >= tmin && t <= tmax;
}

// Whether the ray's place, moved by an infinitely small step to the right and a much smaller one
// upwards, lies inside the edge from p to q, of which the edge function is zero. side: the
// determinant's sign.
FN bool is_moved_inside(vec2 p, vec2 q, real side) {
    real inside = (q.y != p.y ? q.y - p.y : p.x - q.x) * side;
    return inside > real(0.0);
}

// For a triangle that intersect_triangle finds: whether the ray's place, moved by the same
// infinitely small step as for all other triangles, still lies inside. Of triangles that share an
// edge or a vertex, a ray through it crosses exactly one on each layer.
FN bool crosses_triangle(IN(RayShear) shear, vec3 origin, vec3 v0, vec3 v1, vec3 v2) {
    vec3 corner0 = axis_last(shear.axis, v0 - origin);
    vec3 corner1 = axis_last(shear.axis, v1 - origin);
    vec3 corner2 = axis_last(shear.axis, v2 - origin);
    vec2 a = vec2(corner0.x - shear.x * corner0.z, corner0.y - shear.y * corner0.z);
    vec2 b = vec2(corner1.x - shear.x * corner1.z, corner1.y - shear.y * corner1.z);
    vec2 c = vec2(corner2.x - shear.x * corner2.z, corner2.y - shear.y * corner2.z);
    real ea = c.x * b.y - c.y * b.x;
    real eb = a.x * c.y - a.y * c.x;
    real ec = b.x * a.y - b.y * a.x;
    real side = ea + eb + ec > real(0.0) ? real(1.0) : -real(1.0);
    return (ea != real(0.0) || is_moved_inside(b, c, side)) &&
           (eb != real(0.0) || is_moved_inside(c, a, side)) &&
           (ec != real(0.0) || is_moved_inside(a, b, side));
}

// Largest distance along any axis from the origin to a point in the box. The scene's box serves
// every ray.
FN real box_reach(vec3 origin, vec3 low, vec3 high) {
    return max_component(max(abs(low - origin), abs(high - origin)));
}

// Point of a triangle with the weights u, v of its second and third vertex. error: a bound, along
// each axis, on how far rounding moves the point, or a later intersection from it, off the
// triangle's plane. Computing the point alone would need less (Pharr, Jakob and Humphreys,
// "Physically Based Rendering", section 3.9: gamma(7) of the weighted coordinates), but distances
// that intersect_triangle finds from there err by several roundings of the triangle's largest
// coordinate, in any direction. A floor at height 0 has no rounding error in its height, and yet
// rays that start on it would hit it.
FN vec3 hit_point(vec3 v0, vec3 v1, vec3 v2, real u, real v, OUT(vec3) error) {
    error = vec3(max_component(max(abs(v0), max(abs(v1), abs(v2)))) * error_bound(16));
    return v0 * (real(1.0) - u - v) + v1 * u + v2 * v;
}

// The next number after x towards +infinity (up) or -infinity.
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

// Origin of a ray that leaves the surface at p along w: p moved along the triangle's unit normal n
// by the error bound, to the side that w points to. Each coordinate is rounded away from p so that
// rounding does not undo the move. Valid at any scale, except for needles (over 30 times as long as
// high), where about one ray in a hundred still hits its own triangle; a traversal that skips the
// ray's own triangle does not have this problem.
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
