// Isotropic GGX microfacets (Walter et al. 2007) with Smith's height-correlated masking (Heitz
// 2014), in a frame whose z is the surface's normal, for directions above the surface (z > 0) and
// alpha > 0. Nothing here divides by a cosine: grazing directions are as good as others.
#ifndef ARGAND_SHARED_GGX_H
#define ARGAND_SHARED_GGX_H

#include "shared/frame.h"

ARGAND_SHARED_BEGIN

// Density of normals along h, of any length, whose squared length is h2 > 0. With the tangent's
// components, not with 1 - cos², which has no digits left near the peak.
FN real ggx_distribution(real alpha, vec3 h, real h2) {
    real r = h2 / ((h.x * h.x + h.y * h.y) / (alpha * alpha) + h.z * h.z);
    return r * r * INV_PI / (alpha * alpha);
}

// cos θ (1 + 2 Λ), of which masking is made.
FN real ggx_masked_cosine(real alpha, real cosine) {
    real a2 = alpha * alpha;
    return sqrt(a2 + (real(1.0) - a2) * cosine * cosine);
}

// Masking and shadowing over 4 cos θo cos θi, by which distribution and Fresnel's factor are
// multiplied.
FN real ggx_visibility(real alpha, real cosine_o, real cosine_i) {
    return real(0.5) / (cosine_i * ggx_masked_cosine(alpha, cosine_o) +
                        cosine_o * ggx_masked_cosine(alpha, cosine_i));
}

// Unit normal of a microfacet, in proportion to what wo sees of it (Dupuy and Benyoub 2023,
// "Sampling Visible GGX Normals with Spherical Caps").
FN vec3 ggx_sample_normal(real alpha, vec3 wo, vec2 u) {
    vec3 stretched = vec3(wo.x * alpha, wo.y * alpha, wo.z);
    stretched = stretched / sqrt(dot3(stretched, stretched)); // at least alpha long
    real s, c;
    sincos_2pi(u.x, s, c);
    // Uniform z between -stretched.z and 1, by 1 - z and by z + stretched.z: of their difference
    // from 1 and from each other nothing would be left near the ends.
    real height = real(1.0) + stretched.z;
    real below = u.y * height;
    real r = safe_sqrt(below * (real(2.0) - below));
    // At least 2^-24 high, as u.y is.
    vec3 h = vec3((r * c + stretched.x) * alpha, (r * s + stretched.y) * alpha,
                  (real(1.0) - u.y) * height);
    return h / sqrt(dot3(h, h));
}

// Solid-angle density of wo mirrored at such a normal, from the distribution at the half vector.
FN real ggx_reflection_pdf(real alpha, real distribution, real cosine_o) {
    return real(0.5) * distribution / (cosine_o + ggx_masked_cosine(alpha, cosine_o));
}

ARGAND_SHARED_END

#endif
