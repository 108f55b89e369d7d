// Directions towards surfaces close to a light. A lamp 3 mm below a ceiling lights a spot there
// 10^5 times as brightly as places 1 m away. Paths rarely hit that spot, and are fireflies when
// they do. So some paths are aimed past the light. Their density falls with the square of the
// distance at which they pass it, and the light on what they hit falls at least as fast.
#ifndef ARGAND_SHARED_CLOSE_LIGHT_H
#define ARGAND_SHARED_CLOSE_LIGHT_H

#include "shared/cone.h"
#include "shared/elementary.h"

ARGAND_SHARED_BEGIN

// Directions that pass a light, as seen from a point. Their solid-angle density is in proportion to
// 1 / (t + core), with t = 1 - cosine of the angle to the axis.
struct CloseCone {
    Cone cone;  // of height 0: nothing is aimed
    real core;  // t of rays that pass the light as far away as the surfaces close to it
    real range; // natural logarithm of (cone.height + core) / core
};

// light: its position, and the distance of the surfaces close to it. reach: the greatest distance
// at which rays pass the light; for points near the light it is less.
FN CloseCone close_cone(vec4 light, real reach, vec3 from) {
    // A narrower core would cost the logarithm its digits.
    real least_core = real(1.0e-5);
    CloseCone c;
    real distance;
    unit_and_length(vec3(light) - from, distance);
    c.cone = cone_of(vec4(vec3(light), min(reach, distance * real(0.9))), from);
    real height = c.cone.height;
    c.core = max(real(0.5) * sqr(real(light.w) / distance), least_core * height);
    c.range = -log_complement(height / (height + c.core));
    if (!(real(4.0) * c.core < height)) {
        c.cone.height = real(0.0);
    }
    return c;
}

// u: in [0,1).
FN vec3 sample_close_cone(IN(CloseCone) c, vec2 u) {
    real outermost = c.cone.height + c.core;
    real t = outermost * exp_negative((u.x - real(1.0)) * c.range) - c.core;
    return direction_in_cone(c.cone, clamp(t, real(0.0), c.cone.height), u.y);
}

// Solid-angle density with which sample_close_cone() finds this direction.
FN real close_cone_pdf(IN(CloseCone) c, vec3 direction) {
    vec3 chord = direction - c.cone.axis;
    real t = real(0.5) * dot3(chord, chord);
    return t < c.cone.height ? real(0.5) * INV_PI / (c.range * (t + c.core)) : real(0.0);
}

ARGAND_SHARED_END

#endif
