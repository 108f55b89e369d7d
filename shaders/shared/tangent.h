// Tangents of normal textures, relative to an edge of their triangle: so they move with it,
// whatever moves the triangle.
#ifndef ARGAND_SHARED_TANGENT_H
#define ARGAND_SHARED_TANGENT_H

#include "shared/maths.h"

ARGAND_SHARED_BEGIN

// A tangent at a corner of a triangle: cosine and sine of the angle from the triangle's first edge
// to it, both projected onto the plane of the normal, in 16 and 15 bits; between them whether the
// bitangent is left-handed, that is, against normal × tangent.
FN uint pack_tangent(vec2 along, bool left_handed) {
    uint x = uint(floor(clamp(along.x, real(-1.0), real(1.0)) * real(32767.0) + real(32768.5)));
    uint y = uint(floor(clamp(along.y, real(-1.0), real(1.0)) * real(16383.0) + real(16384.5)));
    return x | (left_handed ? 0x10000u : 0u) | (y << 17u);
}

FN vec2 unpack_tangent(uint packed) {
    return vec2((real(packed & 0xffffu) - real(32768.0)) / real(32767.0),
                (real(packed >> 17u) - real(16384.0)) / real(16383.0));
}

FN bool tangent_is_left_handed(uint packed) { return (packed & 0x10000u) != 0u; }

// v without its part along the unit vector n, of length 1; (0,0,0) if nothing is left.
FN vec3 projected_unit(vec3 v, vec3 n) {
    real size;
    vec3 unit = unit_and_length(v, size);
    vec3 flat_part = unit - n * dot3(unit, n);
    unit = unit_and_length(flat_part, size);
    return size > real(1e-6) ? unit : vec3(real(0.0));
}

// Least cosine between the geometric normal and one that a texture has turned.
CONSTANT real LEAST_NORMAL_COSINE = real(0.02);

// The direction of length 1 that lies along `slope` in the frame of tangent, bitangent and normal;
// the normal if the slope is (0,0,0). normal: unit; edge: the triangle's first; tangents: packed
// ones of its corners; b: weights of the second and third.
FN vec3 from_tangents(vec3 normal, vec3 edge, uvec3 tangents, vec2 b, vec3 slope) {
    vec3 x = projected_unit(edge, normal);
    vec2 along = unpack_tangent(tangents.x) * (real(1.0) - b.x - b.y) +
                 unpack_tangent(tangents.y) * b.x + unpack_tangent(tangents.z) * b.y;
    real size;
    vec3 angle = unit_and_length(vec3(along.x, along.y, real(0.0)), size);
    vec3 y = cross3(normal, x);
    vec3 tangent = x * angle.x + y * angle.y;
    vec3 bitangent = y * angle.x - x * angle.y;
    bitangent = tangent_is_left_handed(tangents.x) ? -bitangent : bitangent;
    vec3 turned = unit_and_length(tangent * slope.x + bitangent * slope.y + normal * slope.z, size);
    return size > real(0.0) ? turned : normal;
}

// The normal nearest to n that is on the side of the unit vector `side`.
FN vec3 normal_above(vec3 n, vec3 side) {
    real cosine = dot3(n, side);
    if (cosine >= LEAST_NORMAL_COSINE) {
        return n;
    }
    vec3 flat_part = projected_unit(n, side);
    real sine = sqrt(real(1.0) - LEAST_NORMAL_COSINE * LEAST_NORMAL_COSINE);
    real size;
    return unit_and_length(side * LEAST_NORMAL_COSINE + flat_part * sine, size);
}

// What a texel of a normal texture says: codes 1 to 255 are -1 to 1, so that 128 is exactly 0.
FN vec3 slope_of_texel(vec4 texel, real scale) {
    vec3 slope = (vec3(texel.x, texel.y, texel.z) * real(255.0) - vec3(real(128.0))) / real(127.0);
    return vec3(slope.x * scale, slope.y * scale, slope.z);
}

ARGAND_SHARED_END

#endif
