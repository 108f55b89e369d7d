#ifndef ARGAND_SHARED_MATHS_H
#define ARGAND_SHARED_MATHS_H

#include "shared/elementary.h"

ARGAND_SHARED_BEGIN

CONSTANT real LARGEST_BELOW_1 = real(0.999999940395355224609375); // 1 - 2^-24

FN real sqr(real x) { return x * x; }

FN bool is_finite3(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

FN real max_component(vec3 v) { return max(v.x, max(v.y, v.z)); }

FN real mean_component(vec3 v) { return (v.x + v.y + v.z) * real(0.33333333333333333333); }

// Luminance of linear RGB with BT.709 primaries.
FN real luminance(vec3 c) { return real(0.2126) * c.x + real(0.7152) * c.y + real(0.0722) * c.z; }

// For differences of squares, which rounding may make slightly negative.
FN real safe_sqrt(real x) { return sqrt(max(x, real(0.0))); }

// Products are written out because drivers may add the terms of built-ins in any order.
FN real dot3(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

FN vec3 cross3(vec3 a, vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// Unit vector along v and the length of v; (0,0,0) and 0 if v is zero or not finite. Scales by the
// largest component first, so that no square over- or underflows.
FN vec3 unit_and_length(vec3 v, OUT(real) v_length) {
    real largest = max_component(abs(v));
    v_length = real(0.0);
    if (!is_finite(largest) || !(largest > real(0.0))) {
        return vec3(real(0.0));
    }
    vec3 scaled = v / largest;
    real scaled_length = sqrt(dot3(scaled, scaled)); // at least 1
    v_length = scaled_length * largest;
    return scaled / scaled_length;
}

// Unit vector along `along`; (0,0) if that is zero or not finite.
FN vec2 unit_direction(vec2 along) {
    real size;
    vec3 unit = unit_and_length(vec3(along.x, along.y, real(0.0)), size);
    return vec2(unit.x, unit.y);
}

ARGAND_SHARED_END

#endif
