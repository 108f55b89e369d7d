#version 460
#include "cube_faces.glsl"

#include "shared/kernels/alpha.h"
#include "shared/kernels/imagespace/weights_toward.h"
#include "shared/kernels/material.h"
#include "shared/kernels/passes_light.h"

layout(location = 0) flat in uint triangle;
layout(location = 1) flat in uint face_of_all;
layout(location = 0) out uvec2 texel;

// Where the texel's middle shows the triangle. The rasteriser and the exact test disagree on edges:
// there a point on the triangle's edge is taken.
HitRecord meet(vec3 center, vec3 direction, uvec4 t) {
    vec3 a = vec3(positions[t.x]) - center;
    vec3 b = vec3(positions[t.y]) - center;
    vec3 c = vec3(positions[t.z]) - center;
    HitRecord hit;
    hit.triangle = triangle;
    if (!intersect_triangle(ray_shear(direction), vec3(0.0), a, b, c, 0.0, far_away, hit.t, hit.u,
                            hit.v)) {
        vec2 weights = weights_toward(direction, a, b, c);
        vec3 depths = vec3(dot3(a, direction), dot3(b, direction), dot3(c, direction));
        hit.u = weights.x;
        hit.v = weights.y;
        hit.t = depths.x * (1.0 - hit.u - hit.v) + depths.y * hit.u + depths.z * hit.v;
    }
    return hit;
}

// Whether the surface belongs to this layer of the map (shared/image_space_records.h).
bool is_in_layer(HitRecord hit, uvec4 t, uint map, uint place) {
    bool passes = passes_light(load_material(t.w));
    if (params.layer == layer_opaque) {
        return !passes;
    }
    if (!passes) {
        return false;
    }
    uint first = map * params.layers * cube_texels(params.size) + place;
    if (hit.t >= bits_float(shown[first].y)) {
        return false;
    }
    float before = bits_float(shown[first + cube_texels(params.size)].y);
    return params.layer == layer_first || hit.t > before + params.error;
}

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    uint map = params.first + face_of_all / 6u;
    uint place = (face_of_all % 6u * params.size + pixel.y) * params.size + pixel.x;
    float extent;
    vec3 direction = unit_and_length(cube_direction(place, params.size), extent);
    uvec4 t = corners[triangle];
    HitRecord hit = meet(vec3(centers[map]), direction, t);
    if (!(hit.t > 0.0 && hit.t < far_away)) {
        discard;
    }
    if ((material_features & MATERIAL_ALPHA) != 0u &&
        is_absent(t, coverage_at(t, vec2(hit.u, hit.v)))) {
        discard;
    }
    if (params.layers > 1u && !is_in_layer(hit, t, map, place)) {
        discard;
    }
    // Written, because a depth that is interpolated over a large triangle is less precise.
    gl_FragDepth = min(params.nearest / hit.t, 1.0);
    texel = uvec2(triangle, float_bits(hit.t));
}
