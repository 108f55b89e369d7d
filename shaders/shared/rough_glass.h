// The clear part of a dielectric where it is rough: light that passes a thin wall, and reflection
// and refraction at the interface of a solid. Microfacets reflect and refract as smooth glass does
// (Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough
// Surfaces"), with the distribution and the masking of ggx.h. Directions are in the shading frame,
// wo.z > 0; wi may be on either side.
//
// Thin walls: what a facet lets through leaves it like its reflection, but on the other side
// (KHR_materials_transmission). Light that single scattering loses passes too, in so far as the
// layer does not return it (ggx_energy.h), so a white wall loses none. Solids keep the loss of
// single scattering.
//
// Values are for flux, as BsdfSample::weight is: radiance has eta_scale more.
#ifndef ARGAND_SHARED_ROUGH_GLASS_H
#define ARGAND_SHARED_ROUGH_GLASS_H

#include "shared/bsdf_layers.h"

ARGAND_SHARED_BEGIN

struct BsdfSample {
    vec3 wi;
    // f |cos| / density for flux; for radiance multiply by eta_scale as well.
    vec3 weight;
    real pdf; // solid-angle density; 0 for the delta lobes
    uint lobe;
    real probability; // of choosing this lobe
    // Scale of radiance by refraction: (index on wo's side / index on wi's side)².
    real eta_scale;
};

// Whether the clear part scatters like rough glass. Facets of an index near 1 turn light by so
// little that it goes straight on.
FN bool clear_is_rough(IN(MaterialRecord) m) {
    if (!may_have(m, LOBE_CLEAR) || !(clear_share(m) > real(0.0))) {
        return false;
    }
    real alpha = ggx_alpha(m);
    bool turns = !is_solid(m) || m.ior == float32(0.0) ||
                 alpha * abs(real(m.ior) - real(1.0)) >= SMALLEST_ALPHA;
    return alpha >= SMALLEST_ALPHA && turns;
}

// Index on the far side of a solid's interface over that on the near side. An index of 0 reflects
// all light.
FN real interface_eta(IN(MaterialRecord) m, bool front) {
    if (!is_solid(m) || m.ior == float32(0.0)) {
        return real(1.0);
    }
    return front ? real(m.ior) : real(1.0) / real(m.ior);
}

// Reflectance of a solid's interface: Fresnel's equations, scaled by the factors of the specular
// extension except under total reflection. cosine: with the normal of the (micro)facet.
FN vec3 interface_reflectance(IN(MaterialRecord) m, real cosine, real eta,
                              OUT(real) cosine_refracted) {
    real fresnel = fresnel_dielectric(cosine, eta, cosine_refracted);
    if (!(cosine_refracted > real(0.0))) {
        return vec3(real(1.0));
    }
    return min(vec3(m.specular_r, m.specular_g, m.specular_b) * fresnel, vec3(real(1.0))) *
           real(m.specular);
}

// The same under the material's film, which lies outside, where the index is less.
FN vec3 filmed_interface_reflectance(IN(MaterialRecord) m, real cosine, real eta,
                                     OUT(real) cosine_refracted) {
    vec3 bare = interface_reflectance(m, cosine, eta, cosine_refracted);
    ReflectionParameters r = reflection_parameters(m);
    if (!has_film(r) || !(cosine_refracted > real(0.0)) || !(r.f90 > real(0.0))) {
        return bare;
    }
    real outside = eta < real(1.0) ? cosine_refracted : cosine;
    vec3 filmed = film_reflectance(r.f0 / r.f90, r.film_ior, r.film_thickness, outside) * r.f90;
    return bare * (real(1.0) - r.film) + filmed * r.film;
}

// What passes coat and sheen on the way of light between wo and wi, on either side.
FN real clear_under_cover(IN(MaterialRecord) m, vec3 wo, vec3 wi) {
    if (!may_have(m, MATERIAL_COAT | MATERIAL_SHEEN)) {
        return real(1.0);
    }
    return under_cover(reflection_parameters(m), wo, wi);
}

// What a facet of a solid's interface reflects and lets through.
struct RoughInterface {
    vec3 reflected, transmitted;
    real cosine_refracted;
    // Probabilities with which a sample is reflected and let through. Their sum is 1, but a
    // difference from 1 would lose what passes nearly black glass.
    real reflects, passes;
};

FN RoughInterface rough_interface(IN(MaterialRecord) m, real cosine, real eta) {
    RoughInterface r;
    r.cosine_refracted = real(0.0);
    vec3 reflectance = m.ior > float32(0.0)
                           ? filmed_interface_reflectance(m, cosine, eta, r.cosine_refracted)
                           : vec3(real(1.0));
    r.reflected = reflectance * clear_share(m);
    r.transmitted = base_color(m) * (clear_share(m) * (real(1.0) - max_component(reflectance)));
    real sum = mean_component(r.reflected) + mean_component(r.transmitted);
    r.reflects = sum > real(0.0) ? mean_component(r.reflected) / sum : real(1.0);
    r.passes = sum > real(0.0) ? mean_component(r.transmitted) / sum : real(0.0);
    return r;
}

// Part of the light that facets of a thin wall scatter more than once which passes it, and the
// probability with which a sample is one of it (compare repeated_share).
FN real thin_repeated(IN(ReflectionParameters) r, real average) {
    return real(1.0) - max_component(ggx_repeated_color(r.f0, r.f90, average));
}
FN real thin_repeated_share(IN(ReflectionParameters) r, real lost, real repeated) {
    real f0 = max_component(r.f0);
    real once = (real(1.0) - lost) * (real(1.0) - f0 - (r.f90 - f0) * real(1.0 / 21.0));
    real more = lost * repeated;
    return more / max(more + once, real(1.0e-30));
}

// Albedo of the clear part below coat and sheen for light from a direction of this cosine; what
// facets of solids do is taken to be what a smooth interface does.
FN vec3 rough_clear_albedo(IN(MaterialRecord) m, real cosine, bool front) {
    if (!is_solid(m)) {
        return base_color(m) * (clear_share(m) * passes_layer_at(reflection_parameters(m), cosine));
    }
    real refracted;
    vec3 reflected = m.ior > float32(0.0)
                         ? interface_reflectance(m, cosine, interface_eta(m, front), refracted)
                         : vec3(real(1.0));
    vec3 passed = base_color(m) * (real(1.0) - max_component(reflected));
    return (reflected + passed) * clear_share(m);
}

// Value of a thin wall without the cosine, and density of wi. mirrored: wi on the side of wo.
FN vec3 thin_clear_eval_and_pdf(IN(MaterialRecord) m, vec3 wo, vec3 mirrored, OUT(real) pdf) {
    ReflectionParameters r = reflection_parameters(m);
    vec3 h = wo + mirrored;
    real h2 = dot3(h, h);
    real cosine = min(real(0.5) * sqrt(h2), real(1.0));
    real alpha = ggx_alpha(m);
    real distribution = ggx_distribution(alpha, h, h2);
    real average = ggx_lost_average(alpha);
    real lost = ggx_lost(alpha, wo.z);
    real repeated = thin_repeated(r, average);
    real share = thin_repeated_share(r, lost, repeated);
    pdf = (real(1.0) - share) * ggx_reflection_pdf(alpha, distribution, wo.z) +
          share * ggx_repeated_pdf(alpha, mirrored.z);
    real passed = has_film(r) ? passes_smooth_layer_at(r, cosine)
                              : real(1.0) - max_component(dielectric_fresnel(r, cosine));
    real once = passed * distribution * ggx_visibility(alpha, wo.z, mirrored.z);
    real more = repeated * (INV_PI * lost * (ggx_lost(alpha, mirrored.z) / average));
    return base_color(m) * (clear_share(m) * (once + more));
}

// Value of the clear lobe without the cosine [1/sr], and density of wi if this lobe is sampled.
FN vec3 rough_clear_eval_and_pdf(IN(MaterialRecord) m, vec3 wo, vec3 wi, bool front,
                                 OUT(real) pdf) {
    pdf = real(0.0);
    if (!clear_is_rough(m) || !(wo.z > real(0.0)) || wi.z == real(0.0)) {
        return vec3(real(0.0));
    }
    bool reflects = wi.z > real(0.0);
    if (!is_solid(m)) {
        return reflects ? vec3(real(0.0))
                        : thin_clear_eval_and_pdf(m, wo, vec3(wi.x, wi.y, -wi.z), pdf) *
                              clear_under_cover(m, wo, wi);
    }
    real eta = interface_eta(m, front);
    real alpha = ggx_alpha(m);
    vec3 h = reflects ? wo + wi : wo + wi * eta;
    h = h.z < real(0.0) ? -h : h;
    real h2 = dot3(h, h);
    real size = sqrt(h2);
    real cosine_o = dot3(wo, h); // times size
    real cosine_i = dot3(wi, h); // times size
    // Facets that both directions see from the right side. Where the index is that of the other
    // side, h may vanish.
    if (!(h2 > real(0.0)) || !(cosine_o > real(0.0)) || (cosine_i > real(0.0)) != reflects) {
        return vec3(real(0.0));
    }
    RoughInterface r = rough_interface(m, min(cosine_o / size, real(1.0)), eta);
    real distribution = ggx_distribution(alpha, h, h2);
    real density = ggx_reflection_pdf(alpha, distribution, wo.z);
    real value =
        distribution * ggx_visibility(alpha, wo.z, abs(wi.z)) * clear_under_cover(m, wo, wi);
    if (reflects) {
        pdf = r.reflects * density;
        return r.reflected * value;
    }
    // Solid angle of h over that of wi, times 4 cosines of wo with h, as for reflection it is 1.
    real jacobian = real(4.0) * eta * eta * (cosine_o / h2) * (-cosine_i / h2);
    pdf = r.passes * density * jacobian;
    return r.transmitted * (value * jacobian);
}

// Weight of a sample of the visible normals that leaves with cosine_i: masking of both directions
// over that of wo.
FN real ggx_masking_weight(real alpha, real cosine_o, real cosine_i) {
    real masked_o = ggx_masked_cosine(alpha, cosine_o);
    return cosine_i * (cosine_o + masked_o) /
           (cosine_i * masked_o + cosine_o * ggx_masked_cosine(alpha, cosine_i));
}

// Samples the clear lobe, chosen with probability s.probability. u: in [0, 1). Returns false where
// light is lost.
FN bool sample_rough_clear(IN(MaterialRecord) m, vec3 wo, bool front, vec3 u, INOUT(BsdfSample) s) {
    real alpha = ggx_alpha(m);
    if (!is_solid(m)) {
        ReflectionParameters r = reflection_parameters(m);
        real lost = ggx_lost(alpha, wo.z);
        real share = thin_repeated_share(r, lost, thin_repeated(r, ggx_lost_average(alpha)));
        vec3 mirrored;
        if (u.x < share) {
            mirrored = ggx_sample_repeated(alpha, vec2(u.y, u.z));
        } else {
            vec3 n = ggx_sample_normal(alpha, wo, vec2(u.y, u.z));
            mirrored = n * (real(2.0) * dot3(wo, n)) - wo;
        }
        if (!(mirrored.z > real(0.0))) {
            return false; // lost: facets send it into others
        }
        s.wi = vec3(mirrored.x, mirrored.y, -mirrored.z);
        real pdf;
        vec3 f = thin_clear_eval_and_pdf(m, wo, mirrored, pdf);
        s.pdf = s.probability * pdf;
        s.weight = f * (clear_under_cover(m, wo, s.wi) * mirrored.z / s.pdf);
        return s.pdf > real(0.0);
    }
    real eta = interface_eta(m, front);
    vec3 h = ggx_sample_normal(alpha, wo, vec2(u.y, u.z));
    real cosine = clamp(dot3(wo, h), real(0.0), real(1.0));
    RoughInterface r = rough_interface(m, cosine, eta);
    bool reflects = u.x < r.reflects;
    real density = ggx_reflection_pdf(alpha, ggx_distribution(alpha, h, real(1.0)), wo.z);
    if (reflects) {
        s.wi = h * (real(2.0) * cosine) - wo;
        s.pdf = s.probability * r.reflects * density;
    } else {
        s.wi = (h * cosine - wo) / eta - h * r.cosine_refracted;
        // wo + eta wi, along h
        real along = cosine - eta * r.cosine_refracted;
        s.pdf = s.probability * r.passes * density * real(4.0) * eta * eta * cosine *
                r.cosine_refracted / (along * along);
        s.eta_scale = real(1.0) / (eta * eta);
    }
    if ((s.wi.z > real(0.0)) != reflects || s.wi.z == real(0.0) || !(s.pdf > real(0.0)) ||
        !is_finite(s.pdf)) {
        return false;
    }
    real masking = ggx_masking_weight(alpha, wo.z, abs(s.wi.z)) * clear_under_cover(m, wo, s.wi) /
                   s.probability;
    s.weight =
        reflects ? r.reflected * (masking / r.reflects) : r.transmitted * (masking / r.passes);
    return true;
}

ARGAND_SHARED_END

#endif
