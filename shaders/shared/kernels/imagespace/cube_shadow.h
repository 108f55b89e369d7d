// Finds for each shadow ray how much light passes what cube maps show on its way: their thickness
// (shared/alpha.h).
#include "shared/kernels/alpha.h"
#include "shared/kernels/count.h"

FN uint thickness_at(uint triangle, vec2 b) {
    return has_alpha ? thickness_of(coverage_at(triangles[triangle], b)) : thickness_of_all;
}

#include "shared/kernels/imagespace/cube_search.h"
#include "shared/kernels/imagespace/shadow_map.h"

// Surfaces that let light pass, at most; what is behind more of them is dark.
CONSTANT uint most_passed = 64u;

// The light among the centers at which a shadow ray ends but for rounding errors, or the number of
// such lights.
FN uint light_at_end(vec3 origin, vec3 direction, real t_max) {
    vec3 end = origin + direction * t_max;
    real error = error_bound(16) * (max_component(abs(origin)) + t_max);
    uint center = 0u;
    while (center < params.at_lights &&
           !(max_component(abs(end - vec3(centers[center]))) <= error)) {
        ++center;
    }
    return center;
}

// Thickness of all that the maps show on the ray's way.
FN uint thickness_on_way(real t_max, INOUT(Search) search) {
    uint thickness = 0u;
    for (uint i = 0u; i < most_passed && thickness != thickness_of_all; ++i) {
        search.hit = HitRecord(no_triangle, float32(t_max), ray_lost, float32(0.0));
        search_maps(search);
        if (search.hit.triangle == no_triangle) {
            return thickness;
        }
        thickness = add_thickness(
            thickness, thickness_at(search.hit.triangle, vec2(search.hit.u, search.hit.v)));
        search.passed = search.hit;
        if (params.exact == 0u) {
            // Where texels are points, each map shows a surface at another place, about a texel
            // away.
            search.passed.t *= real(1.0) + real(4.0) / real(params.size);
        }
    }
    return thickness_of_all;
}

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= ELEMENT_COUNT) {
        return;
    }
    uint index = active_rays[i];
    real t_max = real(rays[index].t_max);
    if (t_max < real(0.0)) {
        occluded[index] = thickness_of_all;
        return;
    }
    Search search;
    begin(index, search);
    uint center = light_at_end(search.origin, search.direction, t_max);
    if (center == params.at_lights) {
        occluded[index] = search.escapes ? 0u : thickness_on_way(t_max, search);
        return;
    }
    Receiver at;
    at.place = search.origin - vec3(centers[center]);
    at.distance = t_max;
    at.normal = search.normal;
    at.triangle = search.from;
    occluded[index] = thickness_of(real(1.0) - light_through_map(center, at));
}
