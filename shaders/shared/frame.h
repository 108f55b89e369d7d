#ifndef ARGAND_SHARED_FRAME_H
#define ARGAND_SHARED_FRAME_H

#include "shared/maths.h"

ARGAND_SHARED_BEGIN

struct Frame {
    vec3 x, y, z;   // orthonormal
};

// A frame around the unit vector z (Duff et al. 2017, "Building an orthonormal basis, revisited").
FN Frame make_frame(vec3 z) {
    real s = z.z >= real(0.0) ? real(1.0) : real(-1.0);
    real a = real(-1.0) / (s + z.z);    // |s + z.z| is at least 1
    real b = z.x * z.y * a;
    Frame f;
    f.x = vec3(real(1.0) + s * z.x * z.x * a, s * b, -s * z.x);
    f.y = vec3(b, s + z.y * z.y * a, -z.y);
    f.z = z;
    return f;
}

FN vec3 to_world(Frame f, vec3 v) { return f.x * v.x + f.y * v.y + f.z * v.z; }
FN vec3 to_local(Frame f, vec3 v) { return vec3(dot(f.x, v), dot(f.y, v), dot(f.z, v)); }

// Density cos θ / π over the hemisphere around +z.
FN vec3 sample_cosine_hemisphere(vec2 u) {
    real s, c;
    sincos_2pi(u.x, s, c);
    real r = sqrt(u.y);
    return vec3(r * c, r * s, safe_sqrt(real(1.0) - u.y));
}

// Density 1 / 4π over the sphere.
FN vec3 sample_sphere(vec2 u) {
    real s, c;
    sincos_2pi(u.x, s, c);
    real z = real(1.0) - real(2.0) * u.y;
    real r = real(2.0) * safe_sqrt(u.y * (real(1.0) - u.y));
    return vec3(r * c, r * s, z);
}

// Density 1 / π over the unit disc.
FN vec2 sample_disc(vec2 u) {
    real s, c;
    sincos_2pi(u.x, s, c);
    real r = sqrt(u.y);
    return vec2(r * c, r * s);
}

// A unit vector in 2 × 16 bits (Meyer et al. 2010, "On floating-point normal vectors"); error below 1e-4 rad.
FN uint pack_unit(vec3 v) {
    real inverse = real(1.0) / (abs(v.x) + abs(v.y) + abs(v.z));     // the sum is at least 1
    real x = v.x * inverse;
    real y = v.y * inverse;
    if (v.z < real(0.0)) {
        real folded_x = (real(1.0) - abs(y)) * (x >= real(0.0) ? real(1.0) : real(-1.0));
        real folded_y = (real(1.0) - abs(x)) * (y >= real(0.0) ? real(1.0) : real(-1.0));
        x = folded_x;
        y = folded_y;
    }
    // 32,767 steps on either side of 0, so that the axes are exact.
    uint px = uint(floor(x * real(32767.0) + real(32768.5)));
    uint py = uint(floor(y * real(32767.0) + real(32768.5)));
    return px | (py << 16);
}

FN vec3 unpack_unit(uint p) {
    real x = (real(p & 0xffffu) - real(32768.0)) / real(32767.0);
    real y = (real(p >> 16) - real(32768.0)) / real(32767.0);
    real z = real(1.0) - abs(x) - abs(y);
    real fold = max(-z, real(0.0));
    x += x >= real(0.0) ? -fold : fold;
    y += y >= real(0.0) ? -fold : fold;
    vec3 v = vec3(x, y, z);
    return v / sqrt(dot(v, v));     // on the octahedron, at least 1/√3 from its centre
}

ARGAND_SHARED_END

#endif
