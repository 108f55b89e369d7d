// Isotropic GGX microfacets (Walter et al. 2007) with Smith's height-correlated masking (Heitz
// 2014), in a frame whose z is the surface's normal, for directions above the surface (z > 0) and
// alpha > 0. No function divides by a cosine, so grazing directions need no special case.
#ifndef ARGAND_SHARED_GGX_H
#define ARGAND_SHARED_GGX_H

#include "shared/frame.h"

ARGAND_SHARED_BEGIN

// Density of microfacet normals along h, which may have any length; h2 > 0 is its squared length.
// Uses the tangential components because 1 - cos² has no digits left near the peak.
FN real ggx_distribution(real alpha, vec3 h, real h2) {
    real r = h2 / ((h.x * h.x + h.y * h.y) / (alpha * alpha) + h.z * h.z);
    return r * r * INV_PI / (alpha * alpha);
}

// cos θ (1 + 2 Λ), the building block of masking.
FN real ggx_masked_cosine(real alpha, real cosine) {
    real a2 = alpha * alpha;
    return sqrt(a2 + (real(1.0) - a2) * cosine * cosine);
}

// Masking and shadowing over 4 cos θo cos θi: the factor of distribution and Fresnel reflectance.
FN real ggx_visibility(real alpha, real cosine_o, real cosine_i) {
    return real(0.5) / (cosine_i * ggx_masked_cosine(alpha, cosine_o) +
                        cosine_o * ggx_masked_cosine(alpha, cosine_i));
}

// Samples a unit microfacet normal in proportion to its area visible from wo (Dupuy and Benyoub
// 2023, "Sampling Visible GGX Normals with Spherical Caps"). alpha: along x and along y.
FN vec3 ggx_sample_normal(vec2 alpha, vec3 wo, vec2 u) {
    vec3 stretched = vec3(wo.x * alpha.x, wo.y * alpha.y, wo.z);
    stretched = stretched / sqrt(dot3(stretched, stretched)); // at least the lesser alpha long
    real s, c;
    sincos_2pi(u.x, s, c);
    // z is uniform between -stretched.z and 1. Kept as 1 - z and z + stretched.z, because computing
    // these from z would cancel near either end.
    real height = real(1.0) + stretched.z;
    real below = u.y * height;
    real r = safe_sqrt(below * (real(2.0) - below));
    // h.z is at least 2^-24 because u.y < 1 is a multiple of 2^-24.
    vec3 h = vec3((r * c + stretched.x) * alpha.x, (r * s + stretched.y) * alpha.y,
                  (real(1.0) - u.y) * height);
    return h / sqrt(dot3(h, h));
}
FN vec3 ggx_sample_normal(real alpha, vec3 wo, vec2 u) {
    return ggx_sample_normal(vec2(alpha, alpha), wo, u);
}

// Solid-angle density of wo mirrored at a normal from ggx_sample_normal, given the distribution at
// the half vector.
FN real ggx_reflection_pdf(real alpha, real distribution, real cosine_o) {
    return real(0.5) * distribution / (cosine_o + ggx_masked_cosine(alpha, cosine_o));
}

ARGAND_SHARED_END

#endif
