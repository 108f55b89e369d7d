// The BSDF of glTF 2.0 (appendix B) with KHR_materials_specular, _ior, _transmission, _volume
// (whether a thickness is given; kernels/medium.h absorbs) and _unlit, and modified Phong.
// Directions are in the shading frame: wo and wi point away from the surface, and the frame is
// turned so that wo.z > 0 on either side of it.
//
// The BSDF is a sum of lobes, which are scaled by the surface's alpha (coverage). What passes where
// the surface is absent is not scattered, and no part of it.
// - diffuse: Lambertian, under the specular layer of a dielectric or beside the specular lobe of
//   modified Phong.
// - glossy: GGX reflection by metal and by the dielectric's layer, with what microfacets reflect
//   more than once, or the specular lobe of modified Phong.
// - mirror: the same reflection where the surface is smooth, and reflection at the interface of a
//   solid dielectric.
// - transmit: straight through a thin wall, or refracted at the interface of a solid dielectric;
//   tinted by the base colour; always smooth.
//
// The BSDF is reciprocal except for refraction's factor eta_scale.
#ifndef ARGAND_SHARED_BSDF_H
#define ARGAND_SHARED_BSDF_H

#include "shared/fresnel.h"
#include "shared/ggx_energy.h"
#include "shared/material_record.h"
#include "shared/phong.h"

ARGAND_SHARED_BEGIN

CONSTANT uint LOBE_DIFFUSE = 1u;
CONSTANT uint LOBE_GLOSSY = 2u;
CONSTANT uint LOBE_MIRROR = 4u;
CONSTANT uint LOBE_TRANSMIT = 8u;
CONSTANT uint LOBES_DELTA = 12u; // mirror and transmit
CONSTANT uint LOBES_ALL = 15u;

// Further features of a scene's materials: alpha, GGX lobes, Phong lobes, solids that refract,
// those that absorb, unlit surfaces.
CONSTANT uint MATERIAL_ALPHA = 16u;
CONSTANT uint MATERIAL_GGX = 32u;
CONSTANT uint MATERIAL_PHONG = 64u;
CONSTANT uint MATERIAL_SOLID = 128u;
CONSTANT uint MATERIAL_ABSORPTION = 256u;
CONSTANT uint MATERIAL_UNLIT = 512u;
CONSTANT uint MATERIAL_ALL = 1023u;
// Features that metals and dielectric layers need.
CONSTANT uint MATERIAL_LAYER = 36u; // GGX or mirror

// Below this alpha, single precision cannot tell GGX from a mirror.
CONSTANT real SMALLEST_ALPHA = real(1e-3);

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

// Whether any material of the scene may have one of these features. Kernels specialised to a scene
// know the answer at compile time, so code for absent features vanishes. The result is the same for
// every material of the scene.
FN bool may_have(uint absent, uint bits) { return (absent & bits) != bits; }
FN bool may_have(IN(MaterialRecord) m, uint bits) { return may_have(m.absent, bits); }
FN bool wants_lobe(IN(MaterialRecord) m, uint lobes, uint lobe) {
    return may_have(m, lobe) && (lobes & lobe) != 0u;
}

FN vec3 base_color(IN(MaterialRecord) m) { return vec3(m.base_r, m.base_g, m.base_b); }
FN real ggx_alpha(IN(MaterialRecord) m) { return real(m.roughness) * real(m.roughness); }
FN real coverage(IN(MaterialRecord) m) {
    return may_have(m, MATERIAL_ALPHA) ? real(m.coverage) : real(1.0);
}
FN real metallic(IN(MaterialRecord) m) {
    return may_have(m, MATERIAL_LAYER) ? real(m.metallic) : real(0.0);
}
FN real transmission(IN(MaterialRecord) m) {
    return may_have(m, LOBE_TRANSMIT | MATERIAL_SOLID) ? real(m.transmission) : real(0.0);
}
// Whether metal, layer or Phong lobe of this alpha reflects like a mirror. Says nothing about other
// lobes.
FN bool alpha_is_delta(uint absent, real alpha) {
    return may_have(absent, LOBE_MIRROR) &&
           (!may_have(absent, LOBE_GLOSSY) || alpha < SMALLEST_ALPHA);
}
FN bool roughness_is_delta(IN(MaterialRecord) m) { return alpha_is_delta(m.absent, ggx_alpha(m)); }

// Shares of the surface: absent, metal, and dielectric, the last split into opaque and clear by the
// transmission factor.
FN real pass_share(IN(MaterialRecord) m) { return real(1.0) - coverage(m); }
FN real metal_share(IN(MaterialRecord) m) { return coverage(m) * metallic(m); }
FN real dielectric_share(IN(MaterialRecord) m) { return coverage(m) * (real(1.0) - metallic(m)); }
FN real opaque_share(IN(MaterialRecord) m) {
    return dielectric_share(m) * (real(1.0) - transmission(m));
}
FN real clear_share(IN(MaterialRecord) m) { return dielectric_share(m) * transmission(m); }
FN bool is_solid(IN(MaterialRecord) m) {
    return may_have(m, MATERIAL_SOLID) && clear_share(m) > real(0.0) && m.thickness > float32(0.0);
}

FN bool is_unlit(IN(MaterialRecord) m) { return may_have(m, MATERIAL_UNLIT) && m.unlit != 0u; }

// Share of the surface that is dielectric and reflects by Schlick's approximation.
FN real layer_share(IN(MaterialRecord) m) {
    return is_solid(m) ? opaque_share(m) : dielectric_share(m);
}

// Reflectance of the dielectric's layer at normal incidence, for Schlick's approximation. An index
// of 0 gives an f0 of 1, as KHR_materials_ior requires.
FN vec3 dielectric_f0(IN(MaterialRecord) m) {
    real r = (real(m.ior) - real(1.0)) / (real(m.ior) + real(1.0)); // the index is not negative
    vec3 f0 = vec3(m.specular_r, m.specular_g, m.specular_b) * (r * r);
    return min(f0, vec3(real(1.0))) * real(m.specular);
}

// Material parameters of the diffuse lobe and of the reflection by metal, layer or Phong lobe
// (glossy or mirror) that do not depend on directions. Loops over directions compute them once.
struct ReflectionParameters {
    vec3 base_color;
    // Reflectance at normal incidence of the dielectric's layer; for Phong, of the specular lobe.
    vec3 f0;
    real f90; // of the dielectric's layer
    real opaque_share, metal_share;
    real layer_share; // of the surface: dielectric that reflects by Schlick's approximation
    real alpha;
    real exponent; // of modified Phong, or negative
    uint absent;   // as in MaterialRecord
};

// Modified Phong is non-metallic and opaque; its roughness is set to match the width of its lobe.
FN bool is_phong(IN(ReflectionParameters) r) {
    return may_have(r.absent, MATERIAL_PHONG) && r.exponent >= real(0.0);
}
FN bool is_phong(IN(MaterialRecord) m) {
    return may_have(m, MATERIAL_PHONG) && m.exponent >= float32(0.0);
}

FN ReflectionParameters reflection_parameters(IN(MaterialRecord) m) {
    ReflectionParameters r;
    r.base_color = base_color(m);
    r.f0 = is_phong(m) ? vec3(m.specular_r, m.specular_g, m.specular_b) * coverage(m)
                       : dielectric_f0(m);
    r.f90 = real(m.specular);
    r.opaque_share = opaque_share(m);
    r.metal_share = metal_share(m);
    r.layer_share = layer_share(m);
    r.alpha = ggx_alpha(m);
    r.exponent = real(m.exponent);
    r.absent = m.absent;
    return r;
}

// Reflectance of the dielectric's layer.
FN vec3 dielectric_fresnel(IN(ReflectionParameters) r, real cosine) {
    if (!may_have(r.absent, MATERIAL_LAYER)) {
        return vec3(real(0.0));
    }
    return fresnel_schlick(r.f0, r.f90, cosine);
}

// Reflectance of metal and layer together, without the interface of a solid. For Phong, the albedo
// of the specular lobe with `cosine` belonging to wo.
FN vec3 layer_reflectance(IN(ReflectionParameters) r, real cosine) {
    if (is_phong(r)) {
        return r.f0 * phong_albedo(r.exponent, cosine);
    }
    if (!may_have(r.absent, MATERIAL_LAYER)) {
        return vec3(real(0.0));
    }
    return fresnel_schlick(r.base_color, real(1.0), cosine) * r.metal_share +
           dielectric_fresnel(r, cosine) * r.layer_share;
}

// Whether metal and layer are GGX lobes, which reflect some light more than once.
FN bool layer_is_rough(IN(ReflectionParameters) r) {
    return may_have(r.absent, LOBE_GLOSSY) && may_have(r.absent, MATERIAL_GGX) && !is_phong(r) &&
           !alpha_is_delta(r.absent, r.alpha);
}

// What metal and layer return of the light that microfacets reflect more than once.
FN vec3 repeated_color(IN(ReflectionParameters) r, real lost_average) {
    return ggx_repeated_color(r.base_color, real(1.0), lost_average) * r.metal_share +
           ggx_repeated_color(r.f0, r.f90, lost_average) * r.layer_share;
}

// Albedo of the glossy or mirror lobe of metal and layer for light from a direction of this cosine;
// of a rough one within 0.01.
FN vec3 layer_albedo(IN(ReflectionParameters) r, real cosine) {
    if (!layer_is_rough(r)) {
        return layer_reflectance(r, cosine);
    }
    real lost = ggx_lost(r.alpha, cosine);
    real grazing = ggx_grazing(r.alpha, cosine, lost);
    real inner = real(1.0) - lost - grazing; // weight of the reflectance at normal incidence
    return (r.base_color * inner + vec3(grazing)) * r.metal_share +
           (r.f0 * inner + vec3(r.f90 * grazing)) * r.layer_share +
           repeated_color(r, ggx_lost_average(r.alpha)) * lost;
}

// Probability with which a sample of the rough layer is one of repeated reflection: its share of
// the albedo, as far as Fresnel's factor is the same at all angles.
FN real repeated_share(IN(ReflectionParameters) r, real lost, vec3 repeated) {
    vec3 once =
        (r.base_color + (vec3(real(1.0)) - r.base_color) * real(1.0 / 21.0)) * r.metal_share +
        (r.f0 + (vec3(r.f90) - r.f0) * real(1.0 / 21.0)) * r.layer_share;
    real more = lost * mean_component(repeated);
    // The sum is 0 only where nothing is reflected.
    return more / max(more + (real(1.0) - lost) * mean_component(once), real(1.0e-30));
}

// Part of the light that passes the layer: 1 less Schlick's approximation. grazing_less: 1 less its
// weight of f90. No difference of nearly equal numbers is taken.
FN real passes_layer(IN(ReflectionParameters) r, real grazing_less) {
    if (!may_have(r.absent, MATERIAL_LAYER)) {
        return real(1.0);
    }
    return (real(1.0) - r.f90) + (r.f90 - max_component(r.f0)) * grazing_less;
}

// Part of the light that passes a rough layer, given the means of what single reflection loses and
// of its weight of f90: 1 less its albedo.
FN real passes_rough_layer(IN(ReflectionParameters) r, real lost, real grazing) {
    real f0 = max_component(r.f0);
    real average = ggx_lost_average(r.alpha);
    real repeated = ggx_repeated_color(vec3(f0), r.f90, average).x;
    return max(passes_layer(r, real(1.0) - grazing) + lost * (f0 - repeated), real(0.0));
}

// Part of the light that passes the layer at a cosine to the normal. For a smooth one 1 - (1 -
// c)^5, expanded.
FN real passes_layer_at(IN(ReflectionParameters) r, real cosine) {
    if (layer_is_rough(r)) {
        real lost = ggx_lost(r.alpha, cosine);
        return passes_rough_layer(r, lost, ggx_grazing(r.alpha, cosine, lost));
    }
    real c = clamp(cosine, real(0.0), real(1.0));
    real less = c * (real(5.0) + c * (real(-10.0) + c * (real(10.0) + c * (real(-5.0) + c))));
    return passes_layer(r, less);
}

// Albedo of the diffuse lobe under its layer, for light from a direction of this cosine.
FN vec3 diffuse_albedo(IN(ReflectionParameters) r, real cosine) {
    real passed = is_phong(r) ? real(1.0) : passes_layer_at(r, cosine);
    return r.base_color * (r.opaque_share * passed);
}

// Value of the diffuse lobe, times pi. Light passes the layer twice, at wo and at wi, and what the
// layer throws back from below is not lost (Shirley, Smits, Hu and Lafortune 1997). glTF's appendix
// B mixes diffuse and glossy reflection by Fresnel's factor at the half vector instead: at grazing
// angles a white surface then reflects up to half as much again as it receives, and light between
// two such surfaces grows without bound.
FN vec3 diffuse_reflectance(IN(ReflectionParameters) r, real cosine_o, real cosine_i) {
    vec3 reflectance = diffuse_albedo(r, cosine_o);
    if (is_phong(r) || !may_have(r.absent, MATERIAL_LAYER)) {
        return reflectance;
    }
    // The mean of (1 - c)^5 over the hemisphere is 1/21.
    real average = passes_layer(r, real(20.0 / 21.0));
    if (layer_is_rough(r)) {
        average = passes_rough_layer(r, ggx_lost_average(r.alpha), ggx_grazing_average(r.alpha));
    }
    return reflectance * (passes_layer_at(r, cosine_i) / max(average, real(1.0e-6)));
}

// Reflectance and transmittance of the delta lobes.
struct DeltaLobes {
    vec3 reflected; // by the mirror lobe
    vec3 transmitted;
    real eta; // index on wi's side over index on wo's side; 1 through thin walls
    real cosine_refracted;
};

// Solids follow Fresnel's equations, scaled by the factors of the specular extension except under
// total reflection.
FN DeltaLobes bsdf_delta_lobes(IN(MaterialRecord) m, real cosine, bool front) {
    DeltaLobes delta;
    delta.eta = real(1.0);
    delta.cosine_refracted = cosine;
    ReflectionParameters reflection = reflection_parameters(m);
    delta.reflected =
        roughness_is_delta(m) ? layer_reflectance(reflection, cosine) : vec3(real(0.0));
    delta.transmitted = vec3(real(0.0));
    if (!may_have(m, LOBE_TRANSMIT | MATERIAL_SOLID)) {
        return delta;
    }
    if (!is_solid(m)) {
        real passed = layer_is_rough(reflection)
                          ? passes_layer_at(reflection, cosine)
                          : real(1.0) - max_component(dielectric_fresnel(reflection, cosine));
        delta.transmitted = base_color(m) * (clear_share(m) * passed);
        return delta;
    }
    vec3 reflectance = vec3(real(1.0));
    if (m.ior > float32(0.0)) {
        delta.eta = front ? real(m.ior) : real(1.0) / real(m.ior);
        real fresnel = fresnel_dielectric(cosine, delta.eta, delta.cosine_refracted);
        if (delta.cosine_refracted > real(0.0)) {
            reflectance =
                min(vec3(m.specular_r, m.specular_g, m.specular_b) * fresnel, vec3(real(1.0))) *
                real(m.specular);
        }
    }
    delta.reflected = delta.reflected + reflectance * clear_share(m);
    delta.transmitted = base_color(m) * (clear_share(m) * (real(1.0) - max_component(reflectance)));
    return delta;
}

// LOBE_* bits of the lobes that the material has.
FN uint bsdf_lobes(IN(MaterialRecord) m) {
    uint lobes = 0u;
    bool colored = max_component(base_color(m)) > real(0.0);
    if (may_have(m, LOBE_DIFFUSE) && colored && opaque_share(m) > real(0.0)) {
        lobes |= LOBE_DIFFUSE;
    }
    if (may_have(m, LOBE_GLOSSY | LOBE_MIRROR)) {
        if (metal_share(m) > real(0.0) ||
            (m.specular > float32(0.0) && layer_share(m) > real(0.0))) {
            lobes |= roughness_is_delta(m) ? LOBE_MIRROR : LOBE_GLOSSY;
        }
    }
    if (may_have(m, LOBE_TRANSMIT) && colored && clear_share(m) > real(0.0)) {
        lobes |= LOBE_TRANSMIT;
    }
    if (is_solid(m)) {
        lobes |= LOBE_MIRROR;
    }
    if (is_unlit(m)) {
        lobes = 0u;
    }
    return lobes;
}

// Whether only the diffuse lobe scatters.
FN bool is_lambertian(IN(MaterialRecord) m) { return bsdf_lobes(m) == LOBE_DIFFUSE; }

// Approximate albedo of the masked lobes for light from wo; exact for the delta lobes. front: wo is
// on the side from which the triangle's vertices run counter-clockwise, which is the outside of a
// solid.
FN vec3 bsdf_albedo(IN(MaterialRecord) m, vec3 wo, bool front, uint lobes) {
    vec3 albedo = vec3(real(0.0));
    ReflectionParameters reflection = reflection_parameters(m);
    if (wants_lobe(m, lobes, LOBE_DIFFUSE)) {
        albedo += diffuse_albedo(reflection, wo.z);
    }
    if (wants_lobe(m, lobes, LOBE_GLOSSY) && !roughness_is_delta(m)) {
        albedo += layer_albedo(reflection, wo.z);
    }
    if (wants_lobe(m, lobes, LOBES_DELTA)) {
        DeltaLobes delta = bsdf_delta_lobes(m, wo.z, front);
        albedo += wants_lobe(m, lobes, LOBE_MIRROR) ? delta.reflected : vec3(real(0.0));
        albedo += wants_lobe(m, lobes, LOBE_TRANSMIT) ? delta.transmitted : vec3(real(0.0));
    }
    return albedo;
}

// Probabilities with which bsdf_sample chooses the diffuse lobe, the glossy lobe, or any delta
// lobe; all 0 if the material has none of the masked lobes. They must not depend on the side of wo,
// which bsdf_pdf does not know, so a solid's interface counts with its whole share.
FN vec3 lobe_probabilities(IN(MaterialRecord) m, real cosine, uint lobes) {
    uint present = lobes & bsdf_lobes(m);
    vec3 p = vec3(real(0.0));
    ReflectionParameters reflection = reflection_parameters(m);
    vec3 layer = layer_albedo(reflection, cosine);
    if (wants_lobe(m, present, LOBE_DIFFUSE)) {
        p.x = mean_component(diffuse_albedo(reflection, cosine));
    }
    if (wants_lobe(m, present, LOBE_GLOSSY)) {
        p.y = mean_component(layer);
    }
    if (wants_lobe(m, present, LOBE_MIRROR) && roughness_is_delta(m)) {
        p.z = mean_component(layer);
    }
    if (wants_lobe(m, present, LOBE_MIRROR | LOBE_TRANSMIT) &&
        (is_solid(m) || wants_lobe(m, present, LOBE_TRANSMIT))) {
        p.z += clear_share(m) * max(mean_component(base_color(m)), real(0.04));
    }
    real sum = p.x + p.y + p.z;
    return sum > real(0.0) ? p / sum : p;
}

// Value of the reflection by a rough layer without the cosine [1/sr], and the density of wi. h: sum
// of wo and wi, h2: its squared length, cosine: half its length.
FN vec3 rough_layer_eval_and_pdf(IN(ReflectionParameters) r, vec3 wo, vec3 wi, vec3 h, real h2,
                                 real cosine, OUT(real) pdf) {
    real distribution = ggx_distribution(r.alpha, h, h2);
    vec3 once = layer_reflectance(r, cosine) * (distribution * ggx_visibility(r.alpha, wo.z, wi.z));
    real lost = ggx_lost(r.alpha, wo.z);
    real average = ggx_lost_average(r.alpha);
    vec3 repeated = repeated_color(r, average);
    real share = repeated_share(r, lost, repeated);
    pdf = (real(1.0) - share) * ggx_reflection_pdf(r.alpha, distribution, wo.z) +
          share * ggx_repeated_pdf(r.alpha, wi.z);
    return once + repeated * (INV_PI * lost * (ggx_lost(r.alpha, wi.z) / average));
}

// Samples a direction from a rough layer; it may be below the surface. choice and u: in [0, 1).
FN vec3 rough_layer_sample(IN(ReflectionParameters) r, vec3 wo, real choice, vec2 u) {
    real lost = ggx_lost(r.alpha, wo.z);
    vec3 repeated = repeated_color(r, ggx_lost_average(r.alpha));
    if (choice < repeated_share(r, lost, repeated)) {
        return ggx_sample_repeated(r.alpha, u);
    }
    vec3 h = ggx_sample_normal(r.alpha, wo, u);
    return h * (real(2.0) * dot3(wo, h)) - wo;
}

// Value of the masked diffuse and glossy lobes without the cosine [1/sr], and the solid-angle
// density of wi given the probabilities of these lobes.
FN vec3 bsdf_eval_and_pdf(IN(ReflectionParameters) r, vec3 wo, vec3 wi, uint lobes,
                          vec3 probabilities, OUT(real) pdf) {
    vec3 f = vec3(real(0.0));
    pdf = real(0.0);
    vec3 h = wo + wi;
    real h2 = dot3(h, h);
    if (!(wo.z > real(0.0)) || !(wi.z > real(0.0)) || !(h2 > real(0.0))) {
        return f;
    }
    real cosine = min(real(0.5) * sqrt(h2), real(1.0)); // between wo (or wi) and the half vector
    if (may_have(r.absent, LOBE_DIFFUSE) && (lobes & LOBE_DIFFUSE) != 0u) {
        f = diffuse_reflectance(r, wo.z, wi.z) * INV_PI;
        pdf = probabilities.x * cosine_hemisphere_pdf(wi.z);
    }
    if (may_have(r.absent, LOBE_GLOSSY) && (lobes & LOBE_GLOSSY) != 0u &&
        !alpha_is_delta(r.absent, r.alpha)) {
        if (!may_have(r.absent, MATERIAL_GGX) || is_phong(r)) {
            real power = phong_power(r.exponent, wo, wi);
            pdf += probabilities.y * phong_pdf(r.exponent, power);
            return f + r.f0 * phong_lobe(r.exponent, power);
        }
        real density;
        f += rough_layer_eval_and_pdf(r, wo, wi, h, h2, cosine, density);
        pdf += probabilities.y * density;
    }
    return f;
}

FN vec3 bsdf_eval(IN(ReflectionParameters) r, vec3 wo, vec3 wi, uint lobes) {
    real pdf;
    return bsdf_eval_and_pdf(r, wo, wi, lobes, vec3(real(0.0)), pdf);
}
FN vec3 bsdf_eval(IN(MaterialRecord) m, vec3 wo, vec3 wi, uint lobes) {
    return bsdf_eval(reflection_parameters(m), wo, wi, lobes);
}

// Solid-angle density with which bsdf_sample, given this mask, returns wi from a diffuse or glossy
// lobe.
FN real bsdf_pdf(IN(MaterialRecord) m, vec3 wo, vec3 wi, uint lobes) {
    real pdf;
    bsdf_eval_and_pdf(reflection_parameters(m), wo, wi, lobes, lobe_probabilities(m, wo.z, lobes),
                      pdf);
    return pdf;
}

// Chooses mirror or transmit by u in [0, 1). s.probability: that any delta lobe is chosen.
FN bool sample_delta_lobe(IN(MaterialRecord) m, vec3 wo, bool front, uint lobes, real u,
                          INOUT(BsdfSample) s) {
    real probability = s.probability;
    DeltaLobes delta = bsdf_delta_lobes(m, wo.z, front);
    real reflected =
        wants_lobe(m, lobes, LOBE_MIRROR) ? mean_component(delta.reflected) : real(0.0);
    real transmitted =
        wants_lobe(m, lobes, LOBE_TRANSMIT) ? mean_component(delta.transmitted) : real(0.0);
    real sum = reflected + transmitted;
    if (!(sum > real(0.0))) {
        return false;
    }
    if (may_have(m, LOBE_MIRROR) && u * sum < reflected) {
        s.lobe = LOBE_MIRROR;
        s.wi = vec3(-wo.x, -wo.y, wo.z);
        s.probability = reflected * probability / sum;
        s.weight = delta.reflected * (sum / (reflected * probability));
        return true;
    }
    if (!may_have(m, LOBE_TRANSMIT) || !(transmitted > real(0.0))) {
        return false;
    }
    s.lobe = LOBE_TRANSMIT;
    s.wi = vec3(-wo.x / delta.eta, -wo.y / delta.eta, -delta.cosine_refracted);
    s.probability = transmitted * probability / sum;
    s.weight = delta.transmitted * (sum / (transmitted * probability));
    s.eta_scale = real(1.0) / (delta.eta * delta.eta);
    return true;
}

// Samples a direction from the masked lobes. u.x chooses the lobe, u.y and u.z the direction; u.w
// is not used. Returns false where the light is absorbed.
FN bool bsdf_sample(IN(MaterialRecord) m, vec3 wo, bool front, uint lobes, vec4 u,
                    OUT(BsdfSample) s) {
    s.wi = vec3(real(0.0), real(0.0), real(1.0));
    s.weight = vec3(real(0.0));
    s.pdf = real(0.0);
    s.lobe = 0u;
    s.probability = real(1.0);
    s.eta_scale = real(1.0);
    vec3 p = lobe_probabilities(m, wo.z, lobes);
    if (!(wo.z > real(0.0)) || !(p.x + p.y + p.z > real(0.0))) {
        return false;
    }
    real not_delta = p.x + p.y;
    if (may_have(m, LOBES_DELTA) && p.z > real(0.0) && u.x >= not_delta) {
        // The remainder of u.x is uniform again.
        real left = min((u.x - not_delta) / p.z, real(0.99999994));
        s.probability = p.z;
        return sample_delta_lobe(m, wo, front, lobes, left, s);
    }
    if (!may_have(m, LOBE_GLOSSY) || u.x < p.x || !(p.y > real(0.0))) {
        s.lobe = LOBE_DIFFUSE;
        s.probability = p.x;
        s.wi = sample_cosine_hemisphere(vec2(u.y, u.z));
    } else {
        s.lobe = LOBE_GLOSSY;
        s.probability = p.y;
        if (!may_have(m, MATERIAL_GGX) || is_phong(m)) {
            s.wi = phong_sample(real(m.exponent), wo, vec2(u.y, u.z));
        } else {
            // The remainder of u.x is uniform again.
            s.wi =
                rough_layer_sample(reflection_parameters(m), wo, (u.x - p.x) / p.y, vec2(u.y, u.z));
        }
    }
    if (!(s.wi.z > real(0.0))) {
        return false; // below the surface: energy that single scattering loses
    }
    ReflectionParameters reflection = reflection_parameters(m);
    vec3 f = bsdf_eval_and_pdf(reflection, wo, s.wi, lobes, p, s.pdf);
    if (!(s.pdf > real(0.0))) {
        return false;
    }
    if (p.x == real(1.0)) {
        // All other factors cancel exactly.
        s.weight = diffuse_reflectance(reflection, wo.z, s.wi.z);
    } else {
        s.weight = f * (s.wi.z / s.pdf);
    }
    return true;
}

ARGAND_SHARED_END

#endif
