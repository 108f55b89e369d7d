// Rays from places to points in view.
#include "shared/kernels/photon/linked_place.h"

FN RayRecord no_ray(real why) {
    return RayRecord(real(0.0), real(0.0), real(0.0), why, real(0.0), real(0.0), real(1.0), 0u);
}

// A ray from a place to a point in view, a little above the surface. Returns false if the point is
// on another surface.
FN bool ray_to_view_point(IN(LinkedPlace) place, IN(ViewPointRecord) point, OUT(RayRecord) ray) {
    vec3 chord = vec3(point.x, point.y, point.z) - place.p;
    vec3 normal = unpack_photon_normal(point.normal);
    real distance2 = dot3(chord, chord);
    real excess = dot3(chord, normal + place.normal);
    ray = no_ray(no_view_link);
    if (!(dot3(normal, place.normal) >= same_surface_cosine) ||
        !(excess * excess <= chord_tolerance * chord_tolerance * distance2)) {
        return false;
    }
    real height = view_link_height * sqrt(distance2) + params.error;
    vec3 origin = place.p + height * place.normal;
    real size;
    vec3 direction = unit_and_length(chord + height * (normal - place.normal), size);
    ray = RayRecord(origin.x, origin.y, origin.z, size, direction.x, direction.y, direction.z, 0u);
    return size > real(0.0);
}

// Finds the point in view of a cell. Returns false if there is none. With a return in the loop,
// lavapipe 22.3 misses some.
FN bool find_view_point(uvec4 cell, OUT(ViewPointRecord) point) {
    uint entry = view_cell_entry(cell, params.mask);
    point = view_points[entry];
    while (point.normal != no_view_point && !(point.cell == cell)) {
        entry = (entry + 1u) & params.mask;
        point = view_points[entry];
    }
    return point.normal != no_view_point;
}
