// The BSDF of glTF 2.0 (appendix B) with KHR_materials_specular, _ior, _transmission, _volume
// (whether a thickness is given; kernels/medium.h absorbs) and _unlit, and modified Phong.
// Directions are in the shading frame: wo and wi point away from the surface, and the frame is
// turned so that wo.z > 0 on either side of it.
//
// The BSDF is a sum of lobes, which are scaled by the surface's alpha (coverage). What passes where
// the surface is absent is not scattered, and no part of it.
// - diffuse: Lambertian reflection, under the specular layer of a dielectric or beside the
//   specular lobe of modified Phong, and sheen. Sheen is above the dielectric's layer and is not
//   dimmed by it.
// - glossy: GGX reflection by metal and by the dielectric's layer, with what microfacets reflect
//   more than once, or the specular lobe of modified Phong.
// - mirror: the same reflection where the surface is smooth, and reflection at the interface of a
//   solid dielectric.
// - transmit: straight through a thin wall, or refracted at the interface of a solid dielectric;
//   tinted by the base colour.
// - coat: GGX reflection by a rough coat, or by one with a normal of its own; a smooth one belongs
//   to the mirror lobe.
// - clear: what mirror and transmit do at the clear part of a dielectric, where that is rough
//   (rough_glass.h).
//
// The BSDF is reciprocal except for refraction's factor eta_scale, and for coats with a normal of
// their own (coat_cosines).
#ifndef ARGAND_SHARED_BSDF_H
#define ARGAND_SHARED_BSDF_H

#include "shared/rough_glass.h"

ARGAND_SHARED_BEGIN

// Reflectance and transmittance of the delta lobes.
struct DeltaLobes {
    vec3 reflected; // by the mirror lobe
    vec3 transmitted;
    real eta; // index on wi's side over index on wo's side; 1 through thin walls
    real cosine_refracted;
};

// Where a delta lobe sends light that comes from wo.
FN vec3 mirror_direction(vec3 wo) { return vec3(-wo.x, -wo.y, wo.z); }
FN vec3 transmit_direction(IN(DeltaLobes) delta, vec3 wo) {
    return vec3(-wo.x / delta.eta, -wo.y / delta.eta, -delta.cosine_refracted);
}

// Delta lobes below coat and sheen, with the coat's reflection if it is smooth.
FN DeltaLobes with_cover(IN(MaterialRecord) m, IN(ReflectionParameters) r, vec3 wo,
                         IN(DeltaLobes) bare) {
    DeltaLobes delta = bare;
    if (!is_covered(r)) {
        return delta;
    }
    delta.reflected = delta.reflected * under_cover(r, wo, mirror_direction(wo));
    delta.transmitted = delta.transmitted * under_cover(r, wo, transmit_direction(delta, wo));
    if (has_coat(r) && !coat_is_rough(r)) {
        delta.reflected += vec3(coat_albedo(r, wo) * coverage(m));
    }
    return delta;
}

FN DeltaLobes bsdf_delta_lobes(IN(MaterialRecord) m, vec3 wo, bool front) {
    DeltaLobes delta;
    real cosine = wo.z;
    delta.eta = real(1.0);
    delta.cosine_refracted = cosine;
    ReflectionParameters reflection = reflection_parameters(m);
    delta.reflected =
        roughness_is_delta(m) ? filmed_layer_reflectance(reflection, cosine) : vec3(real(0.0));
    delta.transmitted = vec3(real(0.0));
    if (!may_have(m, LOBE_TRANSMIT | MATERIAL_SOLID) || clear_is_rough(m)) {
        return with_cover(m, reflection, wo, delta);
    }
    if (!is_solid(m)) {
        real passed = has_film(reflection)
                          ? passes_smooth_layer_at(reflection, cosine)
                          : real(1.0) - max_component(dielectric_fresnel(reflection, cosine));
        delta.transmitted = base_color(m) * (clear_share(m) * passed);
        return with_cover(m, reflection, wo, delta);
    }
    vec3 reflectance = vec3(real(1.0));
    if (m.ior > float32(0.0)) {
        delta.eta = front ? real(m.ior) : real(1.0) / real(m.ior);
        reflectance = filmed_interface_reflectance(m, cosine, delta.eta, delta.cosine_refracted);
    }
    delta.reflected = delta.reflected + reflectance * clear_share(m);
    delta.transmitted = base_color(m) * (clear_share(m) * (real(1.0) - max_component(reflectance)));
    return with_cover(m, reflection, wo, delta);
}

// LOBE_* bits of the lobes that the material has.
FN uint bsdf_lobes(IN(MaterialRecord) m) {
    uint lobes = 0u;
    bool colored = max_component(base_color(m)) > real(0.0);
    if (may_have(m, LOBE_DIFFUSE) && colored && opaque_share(m) > real(0.0)) {
        lobes |= LOBE_DIFFUSE;
    }
    if (has_sheen(m) && coverage(m) > real(0.0)) {
        lobes |= LOBE_DIFFUSE;
    }
    if (may_have(m, LOBE_GLOSSY | LOBE_MIRROR)) {
        if (metal_share(m) > real(0.0) ||
            (m.specular > float32(0.0) && layer_share(m) > real(0.0))) {
            lobes |= roughness_is_delta(m) ? LOBE_MIRROR : LOBE_GLOSSY;
        }
    }
    if (may_have(m, MATERIAL_COAT) && m.coat > float32(0.0) && coverage(m) > real(0.0)) {
        lobes |= coat_is_rough(reflection_parameters(m)) ? LOBE_COAT : LOBE_MIRROR;
    }
    if (clear_is_rough(m)) {
        lobes |= colored || is_solid(m) ? LOBE_CLEAR : 0u;
    } else {
        if (may_have(m, LOBE_TRANSMIT) && colored && clear_share(m) > real(0.0)) {
            lobes |= LOBE_TRANSMIT;
        }
        if (is_solid(m)) {
            lobes |= LOBE_MIRROR;
        }
    }
    if (is_unlit(m)) {
        lobes = 0u;
    }
    return lobes;
}

// Whether only the diffuse lobe scatters.
FN bool is_lambertian(IN(MaterialRecord) m) {
    return bsdf_lobes(m) == LOBE_DIFFUSE && !has_sheen(m);
}

// Approximate albedos of the lobes for light from one direction; exact for the delta lobes.
struct LobeAlbedos {
    vec3 diffuse, glossy, mirror, transmit, coat, clear;
};

// Albedos of the masked lobes for light from wo; 0 for all others. front: wo is on the side from
// which the triangle's vertices run counter-clockwise, which is the outside of a solid.
FN LobeAlbedos lobe_albedos(IN(MaterialRecord) m, vec3 wo, bool front, uint lobes) {
    LobeAlbedos a;
    a.diffuse = vec3(real(0.0));
    a.glossy = vec3(real(0.0));
    a.mirror = vec3(real(0.0));
    a.transmit = vec3(real(0.0));
    a.coat = vec3(real(0.0));
    a.clear = vec3(real(0.0));
    ReflectionParameters reflection = reflection_parameters(m);
    if (wants_lobe(m, lobes, LOBE_DIFFUSE)) {
        a.diffuse = diffuse_albedo(reflection, wo.z);
    }
    if (wants_lobe(m, lobes, LOBE_GLOSSY) && !roughness_is_delta(m)) {
        a.glossy = layer_albedo(reflection, wo.z);
    }
    if (is_covered(reflection)) {
        real passed = passes_coat_at(reflection, wo);
        a.diffuse = a.diffuse * passed;
        a.glossy = a.glossy * passed;
        if (wants_lobe(m, lobes, LOBE_DIFFUSE)) {
            a.diffuse += rough_sheen_albedo(reflection, wo.z);
        }
        if (wants_lobe(m, lobes, LOBE_COAT) && coat_is_rough(reflection)) {
            a.coat = vec3(coat_albedo(reflection, wo) * coverage(m));
        }
    }
    if (wants_lobe(m, lobes, LOBES_DELTA)) {
        DeltaLobes delta = bsdf_delta_lobes(m, wo, front);
        a.mirror = wants_lobe(m, lobes, LOBE_MIRROR) ? delta.reflected : vec3(real(0.0));
        a.transmit = wants_lobe(m, lobes, LOBE_TRANSMIT) ? delta.transmitted : vec3(real(0.0));
    }
    if (wants_lobe(m, lobes, LOBE_CLEAR) && clear_is_rough(m)) {
        a.clear = rough_clear_albedo(m, wo.z, front);
    }
    return a;
}

// Sum of the masked lobes' albedos.
FN vec3 sum_of_albedos(IN(LobeAlbedos) a, uint lobes) {
    vec3 sum = (lobes & LOBE_DIFFUSE) != 0u ? a.diffuse : vec3(real(0.0));
    sum += (lobes & LOBE_GLOSSY) != 0u ? a.glossy : vec3(real(0.0));
    sum += (lobes & LOBE_COAT) != 0u ? a.coat : vec3(real(0.0));
    sum += (lobes & LOBE_MIRROR) != 0u ? a.mirror : vec3(real(0.0));
    sum += (lobes & LOBE_TRANSMIT) != 0u ? a.transmit : vec3(real(0.0));
    sum += (lobes & LOBE_CLEAR) != 0u ? a.clear : vec3(real(0.0));
    return sum;
}

FN vec3 bsdf_albedo(IN(MaterialRecord) m, vec3 wo, bool front, uint lobes) {
    return sum_of_albedos(lobe_albedos(m, wo, front, lobes), lobes);
}

// Probabilities with which bsdf_sample chooses the diffuse lobe, the glossy lobe, any delta lobe,
// or any of clear and coat; all 0 if the material has none of the masked lobes. They must not
// depend on the side of wo, which bsdf_pdf does not know, so a solid's interface counts with its
// whole share.
FN vec4 lobe_probabilities(IN(MaterialRecord) m, vec3 wo, uint lobes) {
    real cosine = wo.z;
    uint present = lobes & bsdf_lobes(m);
    vec4 p = vec4(real(0.0));
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
    if (wants_lobe(m, present, LOBE_MIRROR | LOBE_TRANSMIT) && !clear_is_rough(m) &&
        (is_solid(m) || wants_lobe(m, present, LOBE_TRANSMIT))) {
        p.z += clear_share(m) * max(mean_component(base_color(m)), real(0.04));
    }
    if (wants_lobe(m, present, LOBE_CLEAR)) {
        p.w = clear_share(m) * max(mean_component(base_color(m)), real(0.04));
    }
    if (is_covered(reflection)) {
        real passed = passes_coat_at(reflection, wo);
        real coat = coat_albedo(reflection, wo) * coverage(m);
        bool rough = has_coat(reflection) && coat_is_rough(reflection);
        p = p * passed;
        p.x += wants_lobe(m, present, LOBE_DIFFUSE)
                   ? mean_component(rough_sheen_albedo(reflection, cosine))
                   : real(0.0);
        p.z += wants_lobe(m, present, LOBE_MIRROR) && !rough ? coat : real(0.0);
        p.w += wants_lobe(m, present, LOBE_COAT) && rough ? coat : real(0.0);
    }
    real sum = p.x + p.y + p.z + p.w;
    return sum > real(0.0) ? p / sum : p;
}

// Alphas along and across the direction of most spread.
FN vec2 brushed_alphas(IN(ReflectionParameters) r) {
    return vec2(alpha_along(r.alpha_across, r.anisotropy), max(r.alpha_across, SMALLEST_ALPHA));
}

// What facets of a rough layer reflect at most towards wi, without the cosine [1/sr], and the
// density of wi. h and h2: as below.
FN real layer_facets(IN(ReflectionParameters) r, vec3 wo, vec3 wi, vec3 h, real h2, OUT(real) pdf) {
    if (is_anisotropic(r.absent, r.anisotropy)) {
        return brushed_facets(brushed_alphas(r), r.anisotropy, wo, wi, h, h2, pdf);
    }
    real distribution = ggx_distribution(r.alpha, h, h2);
    pdf = ggx_reflection_pdf(r.alpha, distribution, wo.z);
    return distribution * ggx_visibility(r.alpha, wo.z, wi.z);
}

// Value of the reflection by a rough layer without the cosine [1/sr], and the density of wi. h: sum
// of wo and wi, h2: its squared length, cosine: half its length.
FN vec3 rough_layer_eval_and_pdf(IN(ReflectionParameters) r, vec3 wo, vec3 wi, vec3 h, real h2,
                                 real cosine, OUT(real) pdf) {
    real density;
    vec3 once = filmed_layer_reflectance(r, cosine) * layer_facets(r, wo, wi, h, h2, density);
    real lost = ggx_lost(r.alpha, wo.z);
    real average = ggx_lost_average(r.alpha);
    vec3 repeated = repeated_color(r, average);
    real share = repeated_share(r, lost, repeated);
    pdf = (real(1.0) - share) * density + share * ggx_repeated_pdf(r.alpha, wi.z);
    return once + repeated * (INV_PI * lost * (ggx_lost(r.alpha, wi.z) / average));
}

// Samples a direction from a rough layer; it may be below the surface. choice and u: in [0, 1).
FN vec3 rough_layer_sample(IN(ReflectionParameters) r, vec3 wo, real choice, vec2 u) {
    real lost = ggx_lost(r.alpha, wo.z);
    vec3 repeated = repeated_color(r, ggx_lost_average(r.alpha));
    if (choice < repeated_share(r, lost, repeated)) {
        return ggx_sample_repeated(r.alpha, u);
    }
    vec3 h = is_anisotropic(r.absent, r.anisotropy)
                 ? brushed_sample_normal(brushed_alphas(r), r.anisotropy, wo, u)
                 : ggx_sample_normal(r.alpha, wo, u);
    return h * (real(2.0) * dot3(wo, h)) - wo;
}

// Value of the masked diffuse and glossy lobes without the cosine [1/sr], and the solid-angle
// density of wi given the probabilities of these lobes.
FN vec3 bsdf_eval_and_pdf(IN(ReflectionParameters) r, vec3 wo, vec3 wi, uint lobes,
                          vec4 probabilities, OUT(real) pdf) {
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
        if (!may_have(r.absent, MATERIAL_GGX) || is_phong(r)) { // Phong has no coat
            real power = phong_power(r.exponent, wo, wi);
            pdf += probabilities.y * phong_pdf(r.exponent, power);
            return f + r.f0 * phong_lobe(r.exponent, power);
        }
        real density;
        f += rough_layer_eval_and_pdf(r, wo, wi, h, h2, cosine, density);
        pdf += probabilities.y * density;
    }
    if (is_covered(r)) {
        return with_sheen(r, wo, wi, f, (lobes & LOBE_DIFFUSE) != 0u);
    }
    return f;
}

FN vec3 bsdf_eval(IN(ReflectionParameters) r, vec3 wo, vec3 wi, uint lobes) {
    real pdf;
    return bsdf_eval_and_pdf(r, wo, wi, lobes, vec4(real(0.0)), pdf);
}
FN vec3 bsdf_eval(IN(MaterialRecord) m, vec3 wo, vec3 wi, uint lobes) {
    return bsdf_eval(reflection_parameters(m), wo, wi, lobes);
}

// Solid-angle density with which bsdf_sample, given this mask, returns wi from a diffuse or glossy
// lobe.
FN real bsdf_pdf(IN(MaterialRecord) m, vec3 wo, vec3 wi, uint lobes) {
    real pdf;
    bsdf_eval_and_pdf(reflection_parameters(m), wo, wi, lobes, lobe_probabilities(m, wo, lobes),
                      pdf);
    return pdf;
}

// Chooses mirror or transmit by u in [0, 1). s.probability: that any delta lobe is chosen.
FN bool sample_delta_lobe(IN(MaterialRecord) m, vec3 wo, bool front, uint lobes, real u,
                          INOUT(BsdfSample) s) {
    real probability = s.probability;
    DeltaLobes delta = bsdf_delta_lobes(m, wo, front);
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
        s.wi = mirror_direction(wo);
        s.probability = reflected * probability / sum;
        s.weight = delta.reflected * (sum / (reflected * probability));
        return true;
    }
    if (!may_have(m, LOBE_TRANSMIT) || !(transmitted > real(0.0))) {
        return false;
    }
    s.lobe = LOBE_TRANSMIT;
    s.wi = transmit_direction(delta, wo);
    s.probability = transmitted * probability / sum;
    s.weight = delta.transmitted * (sum / (transmitted * probability));
    s.eta_scale = real(1.0) / (delta.eta * delta.eta);
    return true;
}

// Probability with which coat, not clear, is sampled where one of them is.
FN real coat_choice(IN(MaterialRecord) m, vec3 wo, uint lobes) {
    uint present = lobes & bsdf_lobes(m);
    if (!wants_lobe(m, present, LOBE_COAT)) {
        return real(0.0);
    }
    ReflectionParameters r = reflection_parameters(m);
    real coat = coat_albedo(r, wo) * coverage(m);
    real clear = wants_lobe(m, present, LOBE_CLEAR)
                     ? clear_share(m) * max(mean_component(base_color(m)), real(0.04)) *
                           passes_coat_at(r, wo)
                     : real(0.0);
    return coat / max(coat + clear, real(1e-30));
}

// Probability with which a sample of the coat is one of repeated reflection (repeated_share).
FN real coat_repeated_share(real lost, real repeated) {
    real more = lost * repeated;
    return more / (more + (real(1.0) - lost) * real(0.04 + 0.96 / 21.0));
}

// A direction in the coat's frame, given in the shading frame.
FN vec3 to_coat(IN(ReflectionParameters) r, vec3 w) {
    return has_coat_normal(r.absent, r.coat_normal) ? to_local(make_frame(r.coat_normal), w) : w;
}

// Cosine of a direction to the coat's normal over that to the surface's. The value of a coat with
// a normal of its own contains it, for wi, so that the cosine that belongs to the value is that
// with the coat's normal. For light that comes from wo, as photons do, it has to be that of wo.
FN real coat_cosines(IN(MaterialRecord) m, vec3 w) {
    ReflectionParameters r = reflection_parameters(m);
    return has_coat_normal(r.absent, r.coat_normal) ? coat_cosine(r, w) / abs(w.z) : real(1.0);
}

// Value of a rough coat without the cosine [1/sr], and density of wi if this lobe is sampled.
FN vec3 coat_eval_and_pdf(IN(MaterialRecord) m, vec3 surface_wo, vec3 surface_wi, OUT(real) pdf) {
    pdf = real(0.0);
    ReflectionParameters r = reflection_parameters(m);
    if (!(surface_wo.z > real(0.0)) || !(surface_wi.z > real(0.0))) {
        return vec3(real(0.0));
    }
    vec3 wo = to_coat(r, surface_wo);
    vec3 wi = to_coat(r, surface_wi);
    vec3 h = wo + wi;
    real h2 = dot3(h, h);
    if (!has_coat(r) || !coat_is_rough(r) || !(wo.z > real(0.0)) || !(wi.z > real(0.0)) ||
        !(h2 > real(0.0))) {
        return vec3(real(0.0));
    }
    real cosine = min(real(0.5) * sqrt(h2), real(1.0));
    real distribution = ggx_distribution(r.coat_alpha, h, h2);
    real lost = ggx_lost(r.coat_alpha, wo.z);
    real average = ggx_lost_average(r.coat_alpha);
    real repeated = ggx_repeated_color(vec3(real(0.04)), real(1.0), average).x;
    real share = coat_repeated_share(lost, repeated);
    pdf = (real(1.0) - share) * ggx_reflection_pdf(r.coat_alpha, distribution, wo.z) +
          share * ggx_repeated_pdf(r.coat_alpha, wi.z);
    real once = (real(1.0) - real(0.96) * schlick_less(cosine)) * distribution *
                ggx_visibility(r.coat_alpha, wo.z, wi.z);
    real more = repeated * (INV_PI * lost * (ggx_lost(r.coat_alpha, wi.z) / average));
    real value = r.coat * coverage(m) * (once + more);
    if (has_coat_normal(r.absent, r.coat_normal)) {
        real faded = coat_share(r, surface_wo) * coat_share(r, surface_wi) / (r.coat * r.coat);
        value = value * (faded * coat_cosines(m, surface_wi));
    }
    return vec3(value);
}

// Value of one of the lobes that are followed though not smooth, clear or coat, without the cosine,
// and the density with which bsdf_sample, given this mask, returns wi from it.
FN vec3 spread_eval_and_pdf(IN(MaterialRecord) m, vec3 wo, vec3 wi, bool front, uint lobes,
                            uint lobe, OUT(real) pdf) {
    real chosen = lobe_probabilities(m, wo, lobes).w;
    real coat = coat_choice(m, wo, lobes);
    vec3 f;
    if (lobe == LOBE_COAT) {
        f = coat_eval_and_pdf(m, wo, wi, pdf);
        pdf = pdf * chosen * coat;
    } else {
        f = rough_clear_eval_and_pdf(m, wo, wi, front, pdf);
        pdf = pdf * chosen * (real(1.0) - coat);
    }
    return f;
}

// Samples coat or clear. probability: that any of them is chosen. u: in [0, 1).
FN bool sample_spread_lobe(IN(MaterialRecord) m, vec3 wo, bool front, uint lobes, real probability,
                           vec3 u, INOUT(BsdfSample) s) {
    real coat = coat_choice(m, wo, lobes);
    if (!(u.x < coat)) {
        s.lobe = LOBE_CLEAR;
        s.probability = probability * (real(1.0) - coat);
        real left = min((u.x - coat) / (real(1.0) - coat), real(0.99999994));
        return sample_rough_clear(m, wo, front, vec3(left, u.y, u.z), s);
    }
    s.lobe = LOBE_COAT;
    s.probability = probability * coat;
    ReflectionParameters r = reflection_parameters(m);
    real alpha = r.coat_alpha;
    vec3 coat_wo = to_coat(r, wo);
    if (!(coat_wo.z > real(0.0))) {
        return false; // the coat faces away
    }
    real lost = ggx_lost(alpha, coat_wo.z);
    real repeated = ggx_repeated_color(vec3(real(0.04)), real(1.0), ggx_lost_average(alpha)).x;
    if (u.x / coat < coat_repeated_share(lost, repeated)) {
        s.wi = ggx_sample_repeated(alpha, vec2(u.y, u.z));
    } else {
        vec3 n = ggx_sample_normal(alpha, coat_wo, vec2(u.y, u.z));
        s.wi = n * (real(2.0) * dot3(coat_wo, n)) - coat_wo;
    }
    if (has_coat_normal(r.absent, r.coat_normal)) {
        s.wi = to_world(make_frame(r.coat_normal), s.wi);
    }
    real pdf;
    vec3 f = coat_eval_and_pdf(m, wo, s.wi, pdf);
    s.pdf = s.probability * pdf;
    if (!(s.pdf > real(0.0))) {
        return false; // lost below the surface
    }
    s.weight = f * (s.wi.z / s.pdf);
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
    vec4 p = lobe_probabilities(m, wo, lobes);
    if (!(wo.z > real(0.0)) || !(p.x + p.y + p.z + p.w > real(0.0))) {
        return false;
    }
    real not_delta = p.x + p.y;
    if (may_have(m, LOBES_SPREAD) && p.w > real(0.0) && u.x >= not_delta + p.z) {
        // The remainder of u.x is uniform again.
        real left = min((u.x - not_delta - p.z) / p.w, real(0.99999994));
        return sample_spread_lobe(m, wo, front, lobes, p.w, vec3(left, u.y, u.z), s);
    }
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
    if (p.x == real(1.0) && !is_covered(reflection)) {
        // All other factors cancel exactly.
        s.weight = diffuse_reflectance(reflection, wo.z, s.wi.z);
    } else {
        s.weight = f * (s.wi.z / s.pdf);
    }
    return true;
}

ARGAND_SHARED_END

#endif
