#ifndef ARGAND_SHARED_SURFACE_H
#define ARGAND_SHARED_SURFACE_H

#include "shared/intersect.h"
#include "shared/maths.h"

ARGAND_SHARED_BEGIN

// The point of a triangle that a ray hit, seen from the ray's side.
struct Surface {
    vec3 position;
    vec3 error;            // bound of the position's absolute error, per component
    vec3 geometric_normal; // unit, on the side of the ray's origin
    vec3 shading_normal;   // unit, interpolated, within 90° of the direction to the ray's origin
    // The ray came from the side from which the vertices run counter-clockwise.
    bool front;
    // The ray came from above the horizon of the interpolated normal.
    bool above_horizon;
};

// Vertices of a triangle, and their normals; a normal is (0,0,0) where the file gives none.
struct SmoothTriangle {
    vec3 v0, v1, v2;
    vec3 n0, n1, n2;
};

FN vec3 normalize_or(vec3 v, vec3 fallback) {
    real size;
    vec3 unit = unit_and_length(v, size);
    return size > real(0.0) ? unit : fallback;
}

// For triangles whose vertices have no normals.
FN Surface make_flat_surface(vec3 v0, vec3 v1, vec3 v2, real u, real v, vec3 ray_direction) {
    Surface s;
    s.position = hit_point(v0, v1, v2, u, v, s.error);
    vec3 normal = normalize_or(cross3(v1 - v0, v2 - v0), -ray_direction);
    s.front = dot3(normal, ray_direction) < real(0.0);
    s.geometric_normal = s.front ? normal : -normal;
    s.shading_normal = s.geometric_normal;
    s.above_horizon = true;
    return s;
}

FN Surface make_surface(IN(SmoothTriangle) t, real u, real v, vec3 ray_direction) {
    Surface s = make_flat_surface(t.v0, t.v1, t.v2, u, v, ray_direction);
    vec3 shading =
        normalize_or(t.n0 * (real(1.0) - u - v) + t.n1 * u + t.n2 * v, s.geometric_normal);
    shading = dot3(shading, s.geometric_normal) < real(0.0) ? -shading : shading;
    // A shading normal that faces away from the viewer would make the surface black, so the
    // geometric normal replaces it.
    s.above_horizon = dot3(shading, ray_direction) < real(0.0);
    s.shading_normal = s.above_horizon ? shading : s.geometric_normal;
    return s;
}

ARGAND_SHARED_END

#endif
