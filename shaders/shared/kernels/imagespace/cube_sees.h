#include "shared/kernels/imagespace/triangle_plane.h"

// A map shows a place if the plane of the triangle that it shows in that direction is as far, but
// for this share: neighbouring triangles of a curved surface are, though a small map shows only
// some. If it is farther, the place is too small for the map.
CONSTANT real depth_error = real(0.002);

// Surfaces that are seen at a smaller cosine do not count as seen: a texel shows very much of them.
CONSTANT real least_cosine = real(0.05);

// A shadow test, with a candidate's map as shadow map. triangle: on which the place lies;
// no_triangle: unknown.
FN bool map_sees(uint map, vec3 position, uint triangle) {
    vec3 center = vec3(centers[map]);
    real distance;
    vec3 way = unit_and_length(position - center, distance);
    if (!(distance > real(0.0))) {
        return true;
    }
    uint shown = map_texels[map * cube_texels(params.size) + cube_texel(way, params.size)].x;
    if (shown == no_triangle) {
        return false;
    }
    TrianglePlane plane = triangle_plane(shown);
    real cosine = dot3(plane.normal, way);
    real depth = dot3(plane.normal, plane.corner - center) / cosine;
    return abs(cosine) >= least_cosine &&
           (shown == triangle || abs(depth - distance) <= depth_error * distance);
}
