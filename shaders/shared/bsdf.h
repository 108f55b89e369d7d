#ifndef ARGAND_SHARED_BSDF_H
#define ARGAND_SHARED_BSDF_H

#include "shared/fresnel.h"
#include "shared/ggx.h"
#include "shared/material_record.h"

ARGAND_SHARED_BEGIN

// The BSDF of glTF 2.0 (appendix B) with KHR_materials_specular, _ior, _transmission and _volume (only whether it is a
// solid), in the shading frame: normal +z on the viewer's side, wo and wi away from the surface, wo.z > 0. It is a sum
// of lobes:
//   diffuse      Lambertian, under the dielectric's specular layer
//   glossy       GGX reflection of the metal and of the dielectric layer
//   mirror       the same where the surface is smooth
//   transmit     smooth transmission: refraction by a solid, straight on through a thin wall
CONSTANT uint LOBE_DIFFUSE = 1u;
CONSTANT uint LOBE_GLOSSY = 2u;
CONSTANT uint LOBE_MIRROR = 4u;
CONSTANT uint LOBE_TRANSMIT = 8u;

// Below, GGX is so sharp that single precision cannot tell it from a mirror.
CONSTANT real smallest_alpha = real(1e-3);

struct BsdfSample {
    vec3 wi;
    vec3 weight;        // f |cos| / density, for radiance without the factor eta_scale
    real pdf;           // solid-angle density; 0 for mirror and transmission
    uint lobe;
    real eta_scale;     // by which refraction scales radiance: (index at wo's side / index at wi's side)²
};

FN vec3 base_color(IN(MaterialRecord) m) { return vec3(m.base_r, m.base_g, m.base_b); }
FN real ggx_alpha(IN(MaterialRecord) m) { return real(m.roughness) * real(m.roughness); }
FN bool is_smooth(IN(MaterialRecord) m) { return ggx_alpha(m) < smallest_alpha; }
FN bool is_solid(IN(MaterialRecord) m) { return m.transmission > float32(0.0) && m.thickness > float32(0.0); }

// Reflectance of the dielectric layer at normal incidence, KHR_materials_ior and _specular. An index of 0 stands for
// one without limit, which reflects all.
FN vec3 dielectric_f0(IN(MaterialRecord) m) {
    real r = m.ior > float32(0.0) ? (real(m.ior) - real(1.0)) / (real(m.ior) + real(1.0)) : real(1.0);
    return min(vec3(m.specular_r, m.specular_g, m.specular_b) * (r * r), vec3(real(1.0))) * real(m.specular);
}

FN vec3 dielectric_fresnel(IN(MaterialRecord) m, real cosine) {
    return fresnel_schlick(dielectric_f0(m), vec3(real(m.specular)), cosine);
}

FN vec3 metal_fresnel(IN(MaterialRecord) m, real cosine) {
    return fresnel_schlick(base_color(m), vec3(real(1.0)), cosine);
}

FN uint bsdf_lobes(IN(MaterialRecord) m) {
    real metallic = real(m.metallic);
    real transmission = real(m.transmission);
    uint lobes = 0u;
    if (metallic < real(1.0) && transmission < real(1.0)) {
        lobes |= LOBE_DIFFUSE;
    }
    if (metallic < real(1.0) && transmission > real(0.0)) {
        lobes |= LOBE_TRANSMIT | LOBE_MIRROR;
    }
    if (metallic > real(0.0) || m.specular > float32(0.0)) {
        lobes |= is_smooth(m) ? LOBE_MIRROR : LOBE_GLOSSY;
    }
    return lobes;
}

// Shares of the dielectric that is opaque and of that which transmits.
FN real opaque_share(IN(MaterialRecord) m) { return (real(1.0) - real(m.metallic)) * (real(1.0) - real(m.transmission)); }
FN real clear_share(IN(MaterialRecord) m) { return (real(1.0) - real(m.metallic)) * real(m.transmission); }

// What the specular layer reflects for a microfacet at this cosine; the transmitting share's layer is smooth, and left
// to the mirror lobe.
FN vec3 layer_reflectance(IN(MaterialRecord) m, real cosine) {
    return metal_fresnel(m, cosine) * real(m.metallic) + dielectric_fresnel(m, cosine) * opaque_share(m);
}

// Reflectance and refracted cosine of the transmitting share. An index of 0 reflects all. Solids: Fresnel's equations,
// scaled by the specular factor where light comes from outside, as KHR_materials_specular scales the layer.
FN real clear_reflectance(IN(MaterialRecord) m, real cosine, bool front, OUT(real) eta, OUT(real) cosine_refracted) {
    eta = real(1.0);
    cosine_refracted = cosine;
    if (!(m.ior > float32(0.0))) {
        return real(1.0);
    }
    eta = front || !is_solid(m) ? real(m.ior) : real(1.0) / real(m.ior);
    real reflectance = fresnel_dielectric(cosine, eta, cosine_refracted);
    return cosine_refracted > real(0.0) ? reflectance * real(m.specular) : real(1.0);
}

// Reflectance of each lobe for wo, to choose between lobes; exact for mirror and transmission.
FN vec3 bsdf_albedo(IN(MaterialRecord) m, vec3 wo, bool front, uint lobes) {
    vec3 albedo = vec3(real(0.0));
    vec3 layer = layer_reflectance(m, wo.z);
    if ((lobes & LOBE_DIFFUSE) != 0u) {
        albedo += base_color(m) * (opaque_share(m) * (real(1.0) - max_component(dielectric_fresnel(m, wo.z))));
    }
    if ((lobes & LOBE_GLOSSY) != 0u) {
        albedo += layer;
    }
    if ((lobes & (LOBE_MIRROR | LOBE_TRANSMIT)) != 0u) {
        real eta, cosine_refracted;
        real reflected = clear_reflectance(m, wo.z, front, eta, cosine_refracted);
        if ((lobes & LOBE_MIRROR) != 0u) {
            albedo += vec3(reflected * clear_share(m)) + (is_smooth(m) ? layer : vec3(real(0.0)));
        }
        if ((lobes & LOBE_TRANSMIT) != 0u) {
            albedo += base_color(m) * ((real(1.0) - reflected) * clear_share(m));
        }
    }
    return albedo;
}

// Sum of the diffuse and glossy lobes of the mask, without cosine [1/sr].
FN vec3 bsdf_eval(IN(MaterialRecord) m, vec3 wo, vec3 wi, uint lobes) {
    vec3 f = vec3(real(0.0));
    if (!(wo.z > real(0.0)) || !(wi.z > real(0.0))) {
        return f;
    }
    vec3 h = wo + wi;
    h = h / sqrt(dot(h, h));    // both lie above the surface, their sum is not zero
    real cosine = clamp(dot(wo, h), real(0.0), real(1.0));
    if ((lobes & LOBE_DIFFUSE) != 0u) {
        f += base_color(m) * (INV_PI * opaque_share(m) * (real(1.0) - max_component(dielectric_fresnel(m, cosine))));
    }
    if ((lobes & LOBE_GLOSSY) != 0u && !is_smooth(m)) {
        real alpha = ggx_alpha(m);
        real d = ggx_d(alpha, h.z) * ggx_g2(alpha, wo, wi) / (real(4.0) * max(wo.z * wi.z, real(1e-20)));
        f += layer_reflectance(m, cosine) * d;
    }
    return f;
}

// Probability of the diffuse lobe where it and the glossy one are chosen between.
FN real diffuse_probability(IN(MaterialRecord) m, vec3 wo, uint lobes) {
    real diffuse = (lobes & LOBE_DIFFUSE) != 0u ? max_component(bsdf_albedo(m, wo, true, LOBE_DIFFUSE)) : real(0.0);
    real glossy = (lobes & LOBE_GLOSSY) != 0u ? max_component(bsdf_albedo(m, wo, true, LOBE_GLOSSY)) : real(0.0);
    real sum = diffuse + glossy;
    if (!(sum > real(0.0))) {
        return (lobes & LOBE_DIFFUSE) != 0u ? real(1.0) : real(0.0);
    }
    return diffuse / sum;
}

// Solid-angle density with which bsdf_sample, asked for diffuse and glossy lobes alone, gives wi.
FN real bsdf_pdf(IN(MaterialRecord) m, vec3 wo, vec3 wi, uint lobes) {
    if (!(wo.z > real(0.0)) || !(wi.z > real(0.0))) {
        return real(0.0);
    }
    real diffuse = diffuse_probability(m, wo, lobes);
    real pdf = diffuse * wi.z * INV_PI;
    if ((lobes & LOBE_GLOSSY) != 0u && !is_smooth(m)) {
        vec3 h = wo + wi;
        h = h / sqrt(dot(h, h));
        pdf += (real(1.0) - diffuse) * ggx_reflection_pdf(ggx_alpha(m), wo, h);
    }
    return pdf;
}

// Samples a direction among the lobes of the mask; u.x chooses the lobe, u.y and u.z the direction. front: wo is on the
// side from which the triangle runs counter-clockwise, the outside of a solid. False where nothing is scattered.
FN bool bsdf_sample(IN(MaterialRecord) m, vec3 wo, bool front, uint lobes, vec4 u, OUT(BsdfSample) s) {
    s.wi = vec3(real(0.0), real(0.0), real(1.0));
    s.weight = vec3(real(0.0));
    s.pdf = real(0.0);
    s.lobe = 0u;
    s.eta_scale = real(1.0);
    uint available = lobes & bsdf_lobes(m);
    uint rough = available & (LOBE_DIFFUSE | LOBE_GLOSSY);
    real rough_weight = rough != 0u ? max_component(bsdf_albedo(m, wo, front, rough)) : real(0.0);
    real mirror_weight = max_component(bsdf_albedo(m, wo, front, available & LOBE_MIRROR));
    real transmit_weight = max_component(bsdf_albedo(m, wo, front, available & LOBE_TRANSMIT));
    real sum = rough_weight + mirror_weight + transmit_weight;
    if (!(wo.z > real(0.0)) || !(sum > real(0.0))) {
        return false;
    }
    real choice = u.x * sum;
    if (choice < rough_weight) {
        real probability = rough_weight / sum;
        real diffuse = diffuse_probability(m, wo, rough);
        if (choice < diffuse * rough_weight) {
            s.wi = sample_cosine_hemisphere(vec2(u.y, u.z));
            s.lobe = LOBE_DIFFUSE;
        } else {
            vec3 h = ggx_sample_normal(ggx_alpha(m), wo, vec2(u.y, u.z));
            s.wi = h * (real(2.0) * dot(wo, h)) - wo;
            s.lobe = LOBE_GLOSSY;
        }
        if (!(s.wi.z > real(0.0))) {
            return false;
        }
        real pdf = bsdf_pdf(m, wo, s.wi, rough);
        s.pdf = pdf * probability;
        if (rough == LOBE_DIFFUSE && m.specular == float32(0.0)) {
            s.weight = base_color(m) * (opaque_share(m) / probability);   // cosine and density cancel, exactly
        } else {
            s.weight = pdf > real(0.0) ? bsdf_eval(m, wo, s.wi, rough) * (s.wi.z / s.pdf) : vec3(real(0.0));
        }
        return max_component(s.weight) > real(0.0);
    }
    if (choice < rough_weight + mirror_weight || transmit_weight == real(0.0)) {
        s.wi = vec3(-wo.x, -wo.y, wo.z);
        s.weight = bsdf_albedo(m, wo, front, LOBE_MIRROR) * (sum / mirror_weight);
        s.lobe = LOBE_MIRROR;
        return mirror_weight > real(0.0);
    }
    real eta, cosine_refracted;
    clear_reflectance(m, wo.z, front, eta, cosine_refracted);
    s.wi = -wo;
    if (is_solid(m)) {
        s.wi = vec3(-wo.x / eta, -wo.y / eta, -cosine_refracted);
        s.eta_scale = real(1.0) / (eta * eta);
    }
    s.weight = bsdf_albedo(m, wo, front, LOBE_TRANSMIT) * (sum / transmit_weight);
    s.lobe = LOBE_TRANSMIT;
    return true;
}

ARGAND_SHARED_END

#endif
