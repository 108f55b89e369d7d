// The cone of directions in which a sphere is seen.
#ifndef ARGAND_SHARED_CONE_H
#define ARGAND_SHARED_CONE_H

#include "shared/frame.h"

ARGAND_SHARED_BEGIN

// Directions in which a sphere is seen from a point: those within an angle of the axis.
struct Cone {
    vec3 axis;
    real sine2;  // of the angle, squared
    real height; // 1 - cosine of the angle; 0: the point is in the sphere, or nearly
};

FN Cone cone_of(vec4 sphere, vec3 from) {
    Cone c;
    real distance;
    c.axis = unit_and_length(vec3(sphere) - from, distance);
    bool outside = real(sphere.w) * real(1.1) < distance;
    real sine = outside ? real(sphere.w) / distance : real(1.0);
    c.sine2 = sine * sine;
    c.height = outside ? c.sine2 / (real(1.0) + sqrt(real(1.0) - c.sine2)) : real(0.0);
    return c;
}

FN bool is_in_cone(IN(Cone) c, vec3 direction) {
    vec3 across = cross3(c.axis, direction);
    return dot3(c.axis, direction) > real(0.0) && dot3(across, across) <= c.sine2;
}

// The direction whose angle to the axis has a cosine of 1 - below. turn: around it, in [0,1).
FN vec3 direction_in_cone(IN(Cone) c, real below, real turn) {
    real s, k;
    sincos_2pi(turn, s, k);
    real sine = safe_sqrt(below * (real(2.0) - below));
    return to_world(make_frame(c.axis), vec3(sine * k, sine * s, real(1.0) - below));
}

// A direction in the cone, evenly distributed over its solid angle.
FN vec3 sample_cone(IN(Cone) c, vec2 u) { return direction_in_cone(c, u.x * c.height, u.y); }

FN real cone_solid_angle(IN(Cone) c) { return real(2.0) * PI * c.height; }

ARGAND_SHARED_END

#endif
