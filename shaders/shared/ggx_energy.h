// Light that GGX microfacets reflect more than once. A single reflection (ggx.h) loses what it
// sends into other microfacets: 69 % at alpha = 1 along the normal. Kulla and Conty (2017,
// "Revisiting Physically Based Shading at Imageworks") give it back as a lobe of its own,
//
//   f = F lost(o) lost(i) / (pi lost_average),
//
// which is reciprocal and reflects F lost(o) of the light from o. F follows from the Fresnel factor
// averaged over directions: light that leaves after k reflections was reflected by each of them.
//
// `lost` and `grazing` are minimax fits to quadratures of microfacets in double precision, for
// alpha from 10^-3 to 1 and all angles; the tests repeat the quadratures. Below 10^-3 surfaces are
// mirrors.
#ifndef ARGAND_SHARED_GGX_ENERGY_H
#define ARGAND_SHARED_GGX_ENERGY_H

#include "shared/ggx.h"

ARGAND_SHARED_BEGIN

// Position between grazing incidence (-1) and the normal (1). Where alpha is small, albedos change
// over cosines of the order of alpha.
FN real ggx_energy_place(real alpha, real cosine) {
    real t = cosine * (real(1.0) + real(0.7) * alpha) / (cosine + real(0.7) * alpha);
    return real(2.0) * t - real(1.0);
}

FN real quintic(real x, vec3 low, vec3 high) {
    return low.x + x * (low.y + x * (low.z + x * (high.x + x * (high.y + x * high.z))));
}
FN real quartic(real x, real c0, vec4 c) {
    return c0 + x * (c.x + x * (c.y + x * (c.z + x * c.w)));
}

// Share of light from this cosine that a single reflection does not return; within 0.003.
FN real ggx_lost(real alpha, real cosine) {
    real x = ggx_energy_place(alpha, cosine);
    real y = real(2.0) * alpha - real(1.0);
    real t = real(0.5) + real(0.5) * x;
    real near = real(0.5) - real(0.5) * x;
    real smooth_part = quintic(x, vec3(real(0.7874), real(1.3752), real(1.2380)),
                               vec3(real(0.4933), real(-1.2216), real(-1.4025)));
    real middle = real(-0.0082) + x * (real(1.3249) + x * real(1.5443));
    real r0 = quintic(x, vec3(real(0.9224), real(-1.4560), real(1.0151)),
                      vec3(real(1.6654), real(-0.6185), real(-0.2886)));
    real r1 = quintic(x, vec3(real(-0.0868), real(0.9245), real(-2.5186)),
                      vec3(real(-1.1011), real(3.1228), real(-0.8057)));
    real r2 = quintic(x, vec3(real(-0.3897), real(-0.4089), real(3.9205)),
                      vec3(real(-1.0000), real(-5.1447), real(2.6953)));
    real r3 = quintic(x, vec3(real(0.2287), real(0.0741), real(-2.1731)),
                      vec3(real(1.1268), real(2.8417), real(-1.8511)));
    real rough = r0 + y * (r1 + y * (r2 + y * r3));
    real lost = t * (near * (near * smooth_part + alpha * middle) + alpha * alpha * rough);
    return max(lost, real(0.0));
}

// Mean of ggx_lost over the hemisphere, weighted by the cosine; so near that f reflects lost(o)
// within 0.002.
FN real ggx_lost_average(real alpha) {
    real y = real(2.0) * sqrt(alpha) - real(1.0);
    real high =
        y * y * y *
        (real(-0.68263) +
         y * (real(-0.85983) + y * (real(-0.94950) + y * (real(3.35444) - y * real(1.72539)))));
    return alpha * alpha * (real(1.88028) + y * (real(-2.21824) + y * real(1.79073)) + high);
}

// Mean of (1 - c)^5 over what a single reflection returns, c being the cosine with the microfacet's
// normal; Schlick's weight of f90. Within 0.006. lost: ggx_lost of the same arguments.
FN real ggx_grazing(real alpha, real cosine, real lost) {
    real x = ggx_energy_place(alpha, cosine);
    real s = sqrt(alpha);
    real y = real(2.0) * s - real(1.0);
    real m0 =
        quartic(y, real(0.3764), vec4(real(-0.0702), real(-0.1498), real(0.1650), real(-0.0576)));
    real m1 =
        quartic(y, real(-0.2890), vec4(real(-0.0286), real(0.0482), real(-0.0490), real(0.1133)));
    real m2 =
        quartic(y, real(-0.1554), vec4(real(0.0428), real(0.2371), real(0.0077), real(-0.0661)));
    real m3 =
        quartic(y, real(-0.0469), vec4(real(0.0351), real(0.1679), real(0.0190), real(-0.0887)));
    real effective = cosine + s * (m0 + x * (m1 + x * (m2 + x * m3)));
    real less = real(1.0) - clamp(effective, real(0.0), real(1.0));
    real less2 = less * less;
    return (real(1.0) - lost) * less2 * less2 * less;
}

// Mean of ggx_grazing over the hemisphere, weighted by the cosine.
FN real ggx_grazing_average(real alpha) {
    real y = real(2.0) * sqrt(alpha) - real(1.0);
    return quartic(y, real(0.018036),
                   vec4(real(-0.036061), real(0.021477), real(0.013503), real(-0.015033)));
}

// F above for Schlick's Fresnel factor. The mean of (1 - c)^5 over the hemisphere is 1/21.
FN vec3 ggx_repeated_color(vec3 f0, real f90, real lost_average) {
    vec3 average = f0 + (vec3(f90) - f0) * real(1.0 / 21.0);
    // The denominator is at least 1 - lost_average, 0.4.
    return average * average * (real(1.0) - lost_average) /
           (vec3(real(1.0)) - average * lost_average);
}

// Directions for the lobe of repeated reflection. Their density over the cosine is in proportion to
// 1 / (cos² + 9 alpha²), which lost(i) / lost_average exceeds by no more than 1.4 times. u in [0,
// 1).
FN real ggx_repeated_width(real alpha) { return real(9.0) * alpha * alpha; }

// log(1 + 1/w), by the fourth root because 1 less the quotient has no digits left for small w.
FN real ggx_repeated_log(real w) {
    real root = sqrt(sqrt(w / (real(1.0) + w)));
    return real(-4.0) * log_complement(real(1.0) - root);
}
FN vec3 ggx_sample_repeated(real alpha, vec2 u) {
    real w = ggx_repeated_width(alpha);
    real x = -u.y * ggx_repeated_log(w);
    real cosine2 = min(w * exp_complement(x) / exp_negative(x), real(1.0));
    real sine = sqrt(real(1.0) - cosine2);
    real s, c;
    sincos_2pi(u.x, s, c);
    return vec3(sine * c, sine * s, sqrt(cosine2));
}
FN real ggx_repeated_pdf(real alpha, real cosine) {
    real w = ggx_repeated_width(alpha);
    return cosine * INV_PI / ((cosine * cosine + w) * ggx_repeated_log(w));
}

ARGAND_SHARED_END

#endif
