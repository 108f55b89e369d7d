// The specular lobe of the modified Phong BRDF (Lafortune and Willems 1994, "Using the Modified
// Phong Reflectance Model for Physically Based Rendering"), in a frame whose z is the surface's
// normal, for directions above the surface (z > 0):
//
//   f = k_s (n + 2)/(2 pi) cos(angle)^n, angle between wi and wo's mirror direction, up to 90°
//
// Reciprocal. Seen along the normal it reflects k_s, elsewhere less. As n grows it approaches a
// mirror of reflectance k_s cos.
#ifndef ARGAND_SHARED_PHONG_H
#define ARGAND_SHARED_PHONG_H

#include "shared/frame.h"

ARGAND_SHARED_BEGIN

// cos(angle)^n, from the difference of the directions: the cosine itself has no digits left for
// narrow lobes.
FN real phong_power(real n, vec3 wo, vec3 wi) {
    vec3 d = vec3(wi.x + wo.x, wi.y + wo.y, wi.z - wo.z);
    real complement = real(0.5) * dot3(d, d); // 1 - cos(angle)
    return complement < real(1.0) ? exp_negative(n * log_complement(complement)) : real(0.0);
}

// f / k_s, and the solid-angle density of phong_sample; both take phong_power's result.
FN real phong_lobe(real n, real power) { return (n + real(2.0)) * real(0.5) * INV_PI * power; }
FN real phong_pdf(real n, real power) { return (n + real(1.0)) * real(0.5) * INV_PI * power; }

// Samples a direction from the lobe; it may be below the surface. u in [0, 1).
FN vec3 phong_sample(real n, vec3 wo, vec2 u) {
    real complement =
        exp_complement(log_complement(u.y) / (n + real(1.0))); // 1 - (1 - u.y)^(1 / (n + 1))
    real sine = safe_sqrt(complement * (real(2.0) - complement));
    real s, c;
    sincos_2pi(u.x, s, c);
    return to_world(make_frame(vec3(-wo.x, -wo.y, wo.z)),
                    vec3(sine * c, sine * s, real(1.0) - complement));
}

// Approximate share of light from wo that the lobe reflects for k_s = 1, within 0.1. At grazing wo,
// where the surface blocks part of the lobe, it is 1/2 for n = 0 and 0.4/sqrt(n) for large n.
FN real phong_albedo(real n, real cosine) {
    return safe_sqrt(cosine * cosine +
                     (real(1.0) - cosine * cosine) * (real(0.16) / (n + real(0.64))));
}

ARGAND_SHARED_END

#endif
