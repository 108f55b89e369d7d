#ifndef ARGAND_SHARED_FRAME_H
#define ARGAND_SHARED_FRAME_H

#include "shared/maths.h"

ARGAND_SHARED_BEGIN

// An orthonormal, right-handed basis.
struct Frame {
    vec3 x, y, z;
};

// A frame around the unit vector z (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
FN Frame make_frame(vec3 z) {
    real s = z.z >= real(0.0) ? real(1.0) : real(-1.0);
    real a = real(-1.0) / (s + z.z); // the denominator is at least 1 in size
    real b = z.x * z.y * a;
    Frame f;
    f.x = vec3(real(1.0) + s * z.x * z.x * a, s * b, -s * z.x);
    f.y = vec3(b, s + z.y * z.y * a, -z.y);
    f.z = z;
    return f;
}

FN vec3 to_world(IN(Frame) f, vec3 v) { return f.x * v.x + f.y * v.y + f.z * v.z; }
FN vec3 to_local(IN(Frame) f, vec3 v) { return vec3(dot3(f.x, v), dot3(f.y, v), dot3(f.z, v)); }

// All samplers take u in [0, 1)². disc_radius maps u to a point of the unit disc with density 1/pi,
// as a radius (of either sign) and an angle (in turns). Squares map to rings, which keeps
// neighbours together (Shirley and Chiu 1997). The shift by 2^-24 centres to_unit's numbers in
// their cells, exactly, so that no point lies on the rim or at the centre, where the angle is
// undefined.
FN real disc_radius(vec2 u, OUT(real) turn) {
    real a = (real(2.0) * u.x - real(1.0)) + real(5.9604644775390625e-8);
    real b = (real(2.0) * u.y - real(1.0)) + real(5.9604644775390625e-8);
    bool a_longer = abs(a) > abs(b);
    real r = a_longer ? a : b;
    real ratio = r == real(0.0) ? real(0.0) : (a_longer ? b : a) / r;
    turn = a_longer ? ratio * real(0.125) : real(0.25) - ratio * real(0.125);
    return r;
}

FN vec2 sample_disc(vec2 u) {
    real turn, s, c;
    real r = disc_radius(u, turn);
    sincos_2pi(turn, s, c);
    return vec2(r * c, r * s);
}

// Density cos θ / pi over the hemisphere around +z (Malley's method). cos θ is never 0.
FN vec3 sample_cosine_hemisphere(vec2 u) {
    real turn, s, c;
    real r = disc_radius(u, turn);
    sincos_2pi(turn, s, c);
    return vec3(r * c, r * s, safe_sqrt((real(1.0) - abs(r)) * (real(1.0) + abs(r))));
}

FN real cosine_hemisphere_pdf(real cosine) { return max(cosine, real(0.0)) * INV_PI; }

// Density 1 / 4 pi over the sphere.
FN vec3 sample_sphere(vec2 u) {
    real s, c;
    sincos_2pi(u.x, s, c);
    real r = real(2.0) * safe_sqrt(u.y * (real(1.0) - u.y));
    return vec3(r * c, r * s, real(1.0) - real(2.0) * u.y);
}

CONSTANT real UNIFORM_SPHERE_PDF = real(0.079577471545947667884);

// Barycentric weights of the second and third vertex for a uniform point in a triangle.
FN vec2 sample_triangle(vec2 u) {
    real root = sqrt(u.x);
    return vec2(root * (real(1.0) - u.y), root * u.y);
}

// Packs a unit vector: the octahedral map on a square of 2 × 16 bits (Meyer et al. 2010, "On
// Floating-Point Normal Vectors"), with 32,767 steps on either side of 0 so that the axes are
// exact. The error is below 6.5e-5 rad.
FN uint pack_unit(vec3 v) {
    real inverse = real(1.0) / (abs(v.x) + abs(v.y) + abs(v.z)); // the sum is at least 1
    real x = v.x * inverse;
    real y = v.y * inverse;
    if (v.z < real(0.0)) {
        real folded = (real(1.0) - abs(y)) * (x >= real(0.0) ? real(1.0) : real(-1.0));
        y = (real(1.0) - abs(x)) * (y >= real(0.0) ? real(1.0) : real(-1.0));
        x = folded;
    }
    uint px = uint(floor(x * real(32767.0) + real(32768.5)));
    uint py = uint(floor(y * real(32767.0) + real(32768.5)));
    return px | (py << 16u);
}

FN vec3 unpack_unit(uint p) {
    real x = (real(p & 0xffffu) - real(32768.0)) / real(32767.0);
    real y = (real(p >> 16u) - real(32768.0)) / real(32767.0);
    real z = real(1.0) - abs(x) - abs(y);
    real fold = max(-z, real(0.0));
    x += x >= real(0.0) ? -fold : fold;
    y += y >= real(0.0) ? -fold : fold;
    vec3 v = vec3(x, y, z);
    return v / sqrt(dot3(v, v)); // at least 1/sqrt(3) long
}

ARGAND_SHARED_END

#endif
