// What glTF's materials consist of: lobes and features, shares of the surface, and the layers of
// metal and dielectric with the diffuse lobe below; see bsdf.h.
#ifndef ARGAND_SHARED_BSDF_LAYERS_H
#define ARGAND_SHARED_BSDF_LAYERS_H

#include "shared/fresnel.h"
#include "shared/ggx_anisotropic.h"
#include "shared/ggx_energy.h"
#include "shared/iridescence.h"
#include "shared/material_record.h"
#include "shared/phong.h"
#include "shared/sheen.h"

ARGAND_SHARED_BEGIN

CONSTANT uint LOBE_DIFFUSE = 1u;
CONSTANT uint LOBE_GLOSSY = 2u;
CONSTANT uint LOBE_MIRROR = 4u;
CONSTANT uint LOBE_TRANSMIT = 8u;
CONSTANT uint LOBE_CLEAR = 16u;
CONSTANT uint LOBE_COAT = 32u;
CONSTANT uint LOBES_DELTA = 12u;  // mirror and transmit
CONSTANT uint LOBES_SPREAD = 48u; // clear and coat: followed, though not smooth
CONSTANT uint LOBES_ALL = 63u;

// Further features of a scene's materials: alpha, GGX lobes, Phong lobes, solids that refract,
// those that absorb, unlit surfaces, coats, thin films, solids that refract colours differently,
// sheen, anisotropic GGX lobes, coats with a normal of their own, solids that may overlap.
CONSTANT uint MATERIAL_ALPHA = 64u;
CONSTANT uint MATERIAL_GGX = 128u;
CONSTANT uint MATERIAL_PHONG = 256u;
CONSTANT uint MATERIAL_SOLID = 512u;
CONSTANT uint MATERIAL_ABSORPTION = 1024u;
CONSTANT uint MATERIAL_UNLIT = 2048u;
CONSTANT uint MATERIAL_COAT = 4096u;
CONSTANT uint MATERIAL_FILM = 8192u;
CONSTANT uint MATERIAL_DISPERSION = 16384u;
CONSTANT uint MATERIAL_SHEEN = 32768u;
CONSTANT uint MATERIAL_ANISOTROPY = 65536u;
CONSTANT uint MATERIAL_COAT_NORMAL = 131072u;
CONSTANT uint MATERIAL_NESTED = 262144u;
CONSTANT uint MATERIAL_ALL = 524287u;
// All but rough glass, coats, films, dispersion, sheen, anisotropy and solids that overlap. Few
// scenes have these, and they double the size of kernels. A kernel for scenes without them is
// compiled apart, with ARGAND_LEAN.
CONSTANT uint MATERIAL_LEAN = 4047u;
// Diffuse and glossy surfaces, mirrors, and glass that absorbs nothing. A kernel for scenes that
// have only these, and no textures, is compiled with ARGAND_PLAIN.
CONSTANT uint MATERIAL_PLAIN = 655u;
// What this module knows.
#if defined(ARGAND_PLAIN)
CONSTANT uint MATERIAL_KNOWN = MATERIAL_PLAIN;
#elif defined(ARGAND_LEAN)
CONSTANT uint MATERIAL_KNOWN = MATERIAL_LEAN;
#else
CONSTANT uint MATERIAL_KNOWN = MATERIAL_ALL;
#endif
// Features that metals and dielectric layers need.
CONSTANT uint MATERIAL_LAYER = 132u; // GGX or mirror

// Below this alpha, single precision cannot tell GGX from a mirror.
CONSTANT real SMALLEST_ALPHA = real(1e-3);

// Whether any material of the scene may have one of these features. Kernels specialised to a scene
// know the answer at compile time, so code for absent features vanishes. The result is the same for
// every material of the scene.
FN bool may_have(uint absent, uint bits) {
    return (bits & MATERIAL_KNOWN) != 0u && (absent & bits) != bits;
}
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
    return may_have(m, LOBE_TRANSMIT | LOBE_CLEAR | MATERIAL_SOLID) ? real(m.transmission)
                                                                    : real(0.0);
}
// Whether metal, layer or Phong lobe of this alpha reflects like a mirror. Says nothing about other
// lobes.
FN bool alpha_is_delta(uint absent, real alpha) {
    return may_have(absent, LOBE_MIRROR) &&
           (!may_have(absent, LOBE_GLOSSY) || alpha < SMALLEST_ALPHA);
}

FN vec3 coat_normal(IN(MaterialRecord) m) {
    return vec3(m.coat_normal_x, m.coat_normal_y, m.coat_normal_z);
}
// Whether a coat has a normal of its own.
FN bool has_coat_normal(uint absent, vec3 normal) {
    return may_have(absent, MATERIAL_COAT_NORMAL) && normal.z > real(0.0);
}

// Anisotropic metal and layer (KHR_materials_anisotropy): alpha along the direction in which facets
// spread most. Across it is that of the roughness, unless that is a mirror's.
FN real alpha_along(real across, vec2 anisotropy) {
    real strength2 = min(anisotropy.x * anisotropy.x + anisotropy.y * anisotropy.y, real(1.0));
    return across + (real(1.0) - across) * strength2;
}
FN bool is_anisotropic(uint absent, vec2 anisotropy) {
    return may_have(absent, MATERIAL_ANISOTROPY) &&
           (anisotropy.x != real(0.0) || anisotropy.y != real(0.0));
}
FN vec2 anisotropy(IN(MaterialRecord) m) {
    return vec2(real(m.anisotropy_x), real(m.anisotropy_y));
}

// Alpha of metal and layer. If they are anisotropic it is the root of the mean square of both, for
// whatever does not depend on the azimuth.
FN real mean_alpha(uint absent, real across, vec2 anisotropy) {
    if (!is_anisotropic(absent, anisotropy)) {
        return across;
    }
    real along = alpha_along(across, anisotropy);
    return sqrt(real(0.5) * (across * across + along * along));
}
FN real layer_alpha(IN(MaterialRecord) m) {
    return mean_alpha(m.absent, ggx_alpha(m), anisotropy(m));
}
FN bool roughness_is_delta(IN(MaterialRecord) m) {
    return alpha_is_delta(m.absent, layer_alpha(m));
}

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
    real layer_share;      // of the surface: dielectric that reflects by Schlick's approximation
    real alpha;            // mean_alpha
    real alpha_across;     // anisotropic: across the direction of most spread
    vec2 anisotropy;       // as in MaterialRecord, in the shading frame
    real exponent;         // of modified Phong, or negative
    real coat, coat_alpha; // share of what is present, GGX
    vec3 coat_normal;      // in the shading frame; (0,0,0): that of the surface
    real film, film_ior, film_thickness; // as in MaterialRecord
    vec3 sheen;                          // colour, scaled by alpha
    real sheen_most, sheen_alpha;        // largest component of the colour
    uint absent;                         // as in MaterialRecord
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
    r.alpha_across = ggx_alpha(m);
    r.anisotropy = anisotropy(m);
    r.alpha = layer_alpha(m);
    r.exponent = real(m.exponent);
    r.coat = real(m.coat);
    r.coat_normal = coat_normal(m);
    r.coat_alpha = real(m.coat_roughness) * real(m.coat_roughness);
    if (has_coat_normal(m.absent, r.coat_normal)) {
        // Not smooth: the mirror lobe reflects about the surface's normal.
        r.coat_alpha = max(r.coat_alpha, SMALLEST_ALPHA);
    }
    r.film = real(m.film);
    r.film_ior = real(m.film_ior);
    r.film_thickness = real(m.film_thickness);
    r.sheen = vec3(m.sheen_r, m.sheen_g, m.sheen_b) * coverage(m);
    r.sheen_most = max_component(vec3(m.sheen_r, m.sheen_g, m.sheen_b));
    r.sheen_alpha = max(real(m.sheen_roughness) * real(m.sheen_roughness), SMALLEST_SHEEN_ALPHA);
    r.absent = m.absent;
    return r;
}

FN bool has_film(IN(ReflectionParameters) r) {
    return may_have(r.absent, MATERIAL_FILM) && r.film > real(0.0);
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

// The same under the material's film, whose interference takes metal and layer as one surface.
FN vec3 filmed_layer_reflectance(IN(ReflectionParameters) r, real cosine) {
    vec3 bare = layer_reflectance(r, cosine);
    real f90 = r.metal_share + r.f90 * r.layer_share;
    if (!has_film(r) || !(f90 > real(0.0))) {
        return bare;
    }
    vec3 f0 = (r.base_color * r.metal_share + r.f0 * r.layer_share) / f90;
    vec3 filmed =
        film_reflectance(f0, r.film_ior, r.film_thickness, clamp(cosine, real(0.0), real(1.0))) *
        f90;
    return bare * (real(1.0) - r.film) + filmed * r.film;
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

// 1 - (1 - c)^5, expanded.
FN real schlick_less(real cosine) {
    real c = clamp(cosine, real(0.0), real(1.0));
    return c * (real(5.0) + c * (real(-10.0) + c * (real(10.0) + c * (real(-5.0) + c))));
}

// Part of the light that passes the layer at a cosine to the normal.
FN real passes_bare_layer_at(IN(ReflectionParameters) r, real cosine) {
    if (layer_is_rough(r)) {
        real lost = ggx_lost(r.alpha, cosine);
        return passes_rough_layer(r, lost, ggx_grazing(r.alpha, cosine, lost));
    }
    return passes_layer(r, schlick_less(cosine));
}

// Of the light that passes a layer what a film on it lets through, at any wavelength.
FN real passes_film_at(IN(ReflectionParameters) r, real bare, real cosine) {
    real f0 = max_component(r.f0) / max(r.f90, real(1e-30));
    real filmed = r.f90 * most_film_reflectance(f0, r.film_ior, cosine);
    return bare * (real(1.0) - r.film) + (real(1.0) - filmed) * r.film;
}

// Part of the light that passes the layer with its film.
FN real passes_layer_at(IN(ReflectionParameters) r, real cosine) {
    real bare = passes_bare_layer_at(r, cosine);
    return has_film(r) ? passes_film_at(r, bare, cosine) : bare;
}
FN real passes_smooth_layer_at(IN(ReflectionParameters) r, real cosine) {
    real bare = passes_layer(r, schlick_less(cosine));
    return has_film(r) ? passes_film_at(r, bare, cosine) : bare;
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
    if (has_film(r)) {
        // The mean of what passes a film is not known; 1 gains no light.
        average = average * (real(1.0) - r.film) + r.film;
    }
    return reflectance * (passes_layer_at(r, cosine_i) / max(average, real(1.0e-6)));
}

// KHR_materials_clearcoat: a layer of varnish of index 1.5 over all else, as rough as it likes.
// Like the dielectric's layer it returns what microfacets reflect more than once. What is below
// gets what passes the coat where that is less, at wo or at wi: reciprocal, and no light is gained.
// (The extension takes it at wo.)
FN bool has_coat(IN(ReflectionParameters) r) {
    return may_have(r.absent, MATERIAL_COAT) && r.coat > real(0.0);
}

FN bool coat_is_rough(IN(ReflectionParameters) r) {
    return may_have(r.absent, LOBE_COAT) && r.coat_alpha >= SMALLEST_ALPHA;
}

// Cosine of a direction on either side to the coat's normal.
FN real coat_cosine(IN(ReflectionParameters) r, vec3 w) {
    return abs(has_coat_normal(r.absent, r.coat_normal) ? dot3(w, r.coat_normal) : w.z);
}

// Share of the surface on which the coat is, seen along a direction. A coat with a normal of its
// own fades where it would mirror the direction below the surface: what it reflected there would be
// lost, and the surface below it black.
FN real coat_share(IN(ReflectionParameters) r, vec3 w) {
    if (!has_coat_normal(r.absent, r.coat_normal)) {
        return r.coat;
    }
    real mirrored = real(2.0) * dot3(w, r.coat_normal) * r.coat_normal.z - w.z;
    return r.coat * clamp(real(8.0) * mirrored / max(w.z, real(1e-30)), real(0.0), real(1.0));
}

// Part of the light along a direction that passes the coat: what Fresnel's factor leaves, for rough
// coats too, as the extension has it.
FN real passes_coat_at(IN(ReflectionParameters) r, vec3 w) {
    if (!has_coat(r)) {
        return real(1.0);
    }
    real share = coat_share(r, vec3(w.x, w.y, abs(w.z)));
    return (real(1.0) - share) + share * (real(0.96) * schlick_less(coat_cosine(r, w)));
}
FN real coat_albedo(IN(ReflectionParameters) r, vec3 wo) {
    return real(1.0) - passes_coat_at(r, wo);
}
// Sheen lies between the coat and all else, and dims what is below in the same way.
FN bool has_sheen(IN(ReflectionParameters) r) {
    return may_have(r.absent, MATERIAL_SHEEN) && r.sheen_most > real(0.0);
}
FN bool has_sheen(IN(MaterialRecord) m) {
    return may_have(m, MATERIAL_SHEEN) &&
           max_component(vec3(m.sheen_r, m.sheen_g, m.sheen_b)) > real(0.0);
}

// What sheen scatters at a cosine to the normal, roughly: for choices of lobes and albedos.
FN vec3 rough_sheen_albedo(IN(ReflectionParameters) r, real cosine) {
    return has_sheen(r) ? r.sheen * (real(0.15) + real(0.6) * (real(1.0) - cosine))
                        : vec3(real(0.0));
}

// Whether coat or sheen cover the rest, and what passes both.
FN bool is_covered(IN(ReflectionParameters) r) { return has_coat(r) || has_sheen(r); }
FN real passes_cover_at(IN(ReflectionParameters) r, vec3 w) {
    real passed = passes_coat_at(r, w);
    if (has_sheen(r)) {
        passed *= real(1.0) - r.sheen_most * min(sheen_albedo(r.sheen_alpha, abs(w.z)), real(1.0));
    }
    return passed;
}
FN real under_cover(IN(ReflectionParameters) r, vec3 wo, vec3 wi) {
    if (!is_covered(r)) {
        return real(1.0);
    }
    return min(passes_cover_at(r, wo), passes_cover_at(r, wi));
}

// The value of lobes below coat and sheen and of the sheen: `below` without them [1/sr].
FN vec3 with_sheen(IN(ReflectionParameters) r, vec3 wo, vec3 wi, vec3 below, bool with_diffuse) {
    real coat_o = passes_coat_at(r, wo);
    real coat_i = passes_coat_at(r, wi);
    if (!has_sheen(r)) {
        return below * min(coat_o, coat_i);
    }
    real share = r.sheen_most;
    real albedo_o = sheen_albedo(r.sheen_alpha, wo.z);
    real albedo_i = sheen_albedo(r.sheen_alpha, wi.z);
    vec3 f = below * min(coat_o * (real(1.0) - share * min(albedo_o, real(1.0))),
                         coat_i * (real(1.0) - share * min(albedo_i, real(1.0))));
    if (with_diffuse) {
        f += r.sheen *
             (sheen_value(r.sheen_alpha, wo, wi, max(albedo_o, albedo_i)) * min(coat_o, coat_i));
    }
    return f;
}

ARGAND_SHARED_END

#endif
