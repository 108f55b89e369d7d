#ifndef ARGAND_SHARED_GGX_H
#define ARGAND_SHARED_GGX_H

#include "shared/frame.h"

ARGAND_SHARED_BEGIN

// Isotropic GGX microfacets with Smith's height-correlated masking; directions in the shading frame, z > 0.

// Density of microfacet normals m, per projected area.
FN real ggx_d(real alpha, real cosine) {
    real a2 = alpha * alpha;
    // Written so that no difference of nearly equal numbers is formed near the peak: sin² + a² cos².
    real t = max(real(0.0), real(1.0) - cosine * cosine) + a2 * cosine * cosine;
    return a2 * INV_PI / max(t * t, real(1e-30));
}

FN real ggx_lambda(real alpha, vec3 w) {
    real tangent2 = max(real(0.0), real(1.0) - w.z * w.z) / max(w.z * w.z, real(1e-20));
    return real(0.5) * (sqrt(real(1.0) + alpha * alpha * tangent2) - real(1.0));
}

// Share of the microfacets facing wo that wo sees.
FN real ggx_g1(real alpha, vec3 wo) { return real(1.0) / (real(1.0) + ggx_lambda(alpha, wo)); }

FN real ggx_g2(real alpha, vec3 wo, vec3 wi) {
    return real(1.0) / (real(1.0) + ggx_lambda(alpha, wo) + ggx_lambda(alpha, wi));
}

// A microfacet normal among those that wo sees (Dupuy and Benyoub 2023, "Sampling visible GGX normals with spherical
// caps").
FN vec3 ggx_sample_normal(real alpha, vec3 wo, vec2 u) {
    vec3 stretched = vec3(wo.x * alpha, wo.y * alpha, wo.z);
    stretched = stretched / sqrt(dot(stretched, stretched));    // z > 0
    real s, c;
    sincos_2pi(u.x, s, c);
    real z = (real(1.0) - u.y) * (real(1.0) + stretched.z) - stretched.z;
    real r = safe_sqrt(real(1.0) - z * z);
    vec3 h = vec3(r * c, r * s, z) + stretched;
    vec3 m = vec3(h.x * alpha, h.y * alpha, max(h.z, real(1e-7)));
    return m / sqrt(dot(m, m));
}

// Density of the direction into which the normal sampled above reflects wo.
FN real ggx_reflection_pdf(real alpha, vec3 wo, vec3 m) {
    return ggx_g1(alpha, wo) * ggx_d(alpha, m.z) / (real(4.0) * max(wo.z, real(1e-10)));
}

ARGAND_SHARED_END

#endif
