// GGX microfacets that spread more in one direction than across it, as those of brushed metal do;
// see ggx.h. alpha: in that direction and across it; along: the direction, (x, y) of any length.
#ifndef ARGAND_SHARED_GGX_ANISOTROPIC_H
#define ARGAND_SHARED_GGX_ANISOTROPIC_H

#include "shared/ggx.h"

ARGAND_SHARED_BEGIN

// v in the frame whose x is the unit direction `along`.
FN vec3 brushed_frame(vec2 along, vec3 v) {
    return vec3(v.x * along.x + v.y * along.y, v.y * along.x - v.x * along.y, v.z);
}

// cos θ (1 + 2 Λ) of a unit vector in that frame.
FN real brushed_masked_cosine(vec2 alpha, vec3 w) {
    real x = alpha.x * w.x;
    real y = alpha.y * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}

// Distribution times masking and shadowing over 4 cos θo cos θi, and the solid-angle density of wi
// if wo is mirrored at a normal from brushed_sample_normal. h: wo + wi, h2: its squared length.
FN real brushed_facets(vec2 alpha, vec2 along, vec3 wo, vec3 wi, vec3 h, real h2, OUT(real) pdf) {
    vec2 unit = unit_direction(along);
    vec3 half_vector = brushed_frame(unit, h);
    real masked_o = brushed_masked_cosine(alpha, brushed_frame(unit, wo));
    real masked_i = brushed_masked_cosine(alpha, brushed_frame(unit, wi));
    real x = half_vector.x / alpha.x;
    real y = half_vector.y / alpha.y;
    real r = h2 / (x * x + y * y + h.z * h.z);
    real distribution = r * r * INV_PI / (alpha.x * alpha.y);
    pdf = real(0.5) * distribution / (wo.z + masked_o);
    return real(0.5) * distribution / (wi.z * masked_o + wo.z * masked_i);
}

// Samples a unit microfacet normal in proportion to its area visible from wo.
FN vec3 brushed_sample_normal(vec2 alpha, vec2 along, vec3 wo, vec2 u) {
    vec2 unit = unit_direction(along);
    vec3 h = ggx_sample_normal(alpha, brushed_frame(unit, wo), u);
    return vec3(h.x * unit.x - h.y * unit.y, h.x * unit.y + h.y * unit.x, h.z);
}

ARGAND_SHARED_END

#endif
