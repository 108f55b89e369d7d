// Functions of surfaces, rays and scattering.
#ifndef ARGAND_TEST_SCATTER_FUNCTIONS_H
#define ARGAND_TEST_SCATTER_FUNCTIONS_H

#include "arguments.h"
#include "shared/bsdf.h"
#include "shared/camera.h"
#include "shared/follow.h"
#include "shared/surface.h"

ARGAND_SHARED_BEGIN

CONSTANT uint of_fresnel_dielectric = 30u;
CONSTANT uint of_fresnel_schlick = 31u;
CONSTANT uint of_ggx_distribution = 32u;
CONSTANT uint of_ggx_visibility = 33u;
CONSTANT uint of_ggx_sample_normal = 34u;
CONSTANT uint of_ggx_reflection_pdf = 35u;
CONSTANT uint of_phong_power = 36u;
CONSTANT uint of_phong_sample = 37u;
CONSTANT uint of_phong_lobe = 38u;
CONSTANT uint of_bsdf_delta_lobes = 39u;
CONSTANT uint of_refracted = 40u;
CONSTANT uint of_lobe_probabilities = 41u;
CONSTANT uint of_bsdf_albedo = 42u;
CONSTANT uint of_bsdf_eval_and_pdf = 43u;
CONSTANT uint of_bsdf_sample = 44u;
CONSTANT uint of_ray_shear = 45u;
CONSTANT uint of_intersect_triangle = 46u;
CONSTANT uint of_box_reach = 47u;
CONSTANT uint of_hit_point = 48u;
CONSTANT uint of_offset_ray_origin = 49u;
CONSTANT uint of_make_surface = 50u;
CONSTANT uint of_camera_ray = 51u;
CONSTANT uint of_intersect_sliver = 52u;
CONSTANT uint of_normalize_or = 53u;
CONSTANT uint of_bsdf_eval = 54u;
CONSTANT uint of_bsdf_pdf = 55u;
CONSTANT uint of_followed_lobes = 56u;
CONSTANT uint of_path_state = 57u;
CONSTANT uint of_rough_clear = 58u;
CONSTANT uint of_brushed = 59u;
CONSTANT uint end_of_scatter = 60u;

// A material from the sixteen numbers from k on.
// A direction of this cosine; the functions that take it depend on nothing else of it.
FN vec3 above(real cosine) { return vec3(real(0.0), real(0.0), cosine); }

FN MaterialRecord material_at(IN(Arguments) a, int k) {
    MaterialRecord m;
    m.base_r = a.x[k];
    m.base_g = a.x[k + 1];
    m.base_b = a.x[k + 2];
    m.metallic = a.x[k + 3];
    m.specular_r = a.x[k + 4];
    m.specular_g = a.x[k + 5];
    m.specular_b = a.x[k + 6];
    m.specular = a.x[k + 7];
    m.roughness = a.x[k + 8];
    m.transmission = a.x[k + 9];
    m.ior = a.x[k + 10];
    m.thickness = a.x[k + 11];
    m.coverage = a.x[k + 12];
    m.exponent = a.x[k + 13];
    m.absorption_r = real(0.0);
    m.absorption_g = real(0.0);
    m.absorption_b = real(0.0);
    m.unlit = 0u;
    m.coat = m.coat_roughness = m.dispersion = float32(0.0);
    m.film = m.film_thickness = m.anisotropy_x = m.anisotropy_y = float32(0.0);
    m.film_ior = float32(1.3);
    m.sheen_r = m.sheen_g = m.sheen_b = m.sheen_roughness = float32(0.0);
    m.emission_r = m.emission_g = m.emission_b = float32(0.0);
    m.double_sided = 0u;
    m.coat_normal_x = m.coat_normal_y = m.coat_normal_z = float32(0.0);
    m.absent = m.textures = 0u;
    return m;
}

#ifdef ARGAND_REAL_DOUBLE
// State and layer of a path, derived from all of its vertices at once.
FN uvec2 path_by_vertices(uint vertices, uint followed) {
    uint first = 0u; // first estimated vertex
    while (first < vertices && ((followed >> first) & 1u) != 0u) {
        ++first;
    }
    if (first == vertices) {
        return uvec2(0u, layer_direct);
    }
    uint behind = vertices - first - 1u;
    uint all = (1u << behind) - 1u;
    bool caustic = ((followed >> (first + 1u)) & all) == all;
    return uvec2(path_estimated | (caustic ? path_followed : 0u) | behind,
                 behind == 0u ? layer_direct
                 : caustic    ? layer_caustic
                              : layer_indirect);
}
#endif

// Evaluates lobes of materials. Returns false for any other.
FN bool evaluate_lobes(uint function, IN(Arguments) a, INOUT(Values) r) {
    real s;
    if (function == of_fresnel_dielectric) {
        real reflectance = fresnel_dielectric(number_at(a, 0), number_at(a, 1), s);
        r.y[0] = s > real(0.0) ? real(1.0) : real(0.0);
        r.y[1] = reflectance;
        r.y[2] = s;
    } else if (function == of_fresnel_schlick) {
        put3(r, 0, fresnel_schlick(vec3_at(a, 0), number_at(a, 3), number_at(a, 4)));
    } else if (function == of_ggx_distribution) {
        vec3 h = vec3_at(a, 1);
        r.y[0] = ggx_distribution(number_at(a, 0), h, dot3(h, h));
    } else if (function == of_ggx_visibility) {
        r.y[0] = ggx_visibility(number_at(a, 0), number_at(a, 1), number_at(a, 2));
    } else if (function == of_ggx_sample_normal) {
        put3(r, 0, ggx_sample_normal(number_at(a, 0), vec3_at(a, 1), vec2_at(a, 4)));
    } else if (function == of_ggx_reflection_pdf) {
        r.y[0] = ggx_reflection_pdf(number_at(a, 0), number_at(a, 1), number_at(a, 2));
    } else if (function == of_brushed) {
        vec2 alpha = vec2_at(a, 8);
        vec2 along = vec2_at(a, 10);
        vec3 h = vec3_at(a, 0) + vec3_at(a, 3);
        put3(r, 0, brushed_sample_normal(alpha, along, vec3_at(a, 0), vec2_at(a, 6)));
        r.y[3] = brushed_facets(alpha, along, vec3_at(a, 0), vec3_at(a, 3), h, dot3(h, h), s);
        r.y[4] = s;
    } else if (function == of_phong_power) {
        r.y[0] = phong_power(number_at(a, 0), vec3_at(a, 1), vec3_at(a, 4));
    } else if (function == of_phong_sample) {
        put3(r, 0, phong_sample(number_at(a, 0), vec3_at(a, 1), vec2_at(a, 4)));
    } else if (function == of_phong_lobe) {
        r.y[0] = phong_lobe(number_at(a, 0), number_at(a, 1));
        r.y[1] = phong_pdf(number_at(a, 0), number_at(a, 1));
        r.y[2] = phong_albedo(number_at(a, 0), number_at(a, 1));
    } else if (function == of_bsdf_delta_lobes) {
        DeltaLobes b =
            bsdf_delta_lobes(material_at(a, 1), above(number_at(a, 0)), small_at(a, 15) != 0u);
        r.y[0] = b.cosine_refracted > real(0.0) ? real(1.0) : real(0.0);
        put3(r, 1, b.reflected);
        put3(r, 4, b.transmitted);
        r.y[7] = b.eta;
        r.y[8] = b.cosine_refracted;
    } else if (function == of_refracted) {
        vec3 wo = vec3_at(a, 0);
        real eta = number_at(a, 3);
        fresnel_dielectric(wo.z, eta, s);
        r.y[0] = s > real(0.0) ? real(1.0) : real(0.0);
        put3(r, 1, s > real(0.0) ? vec3(-wo.x / eta, -wo.y / eta, -s) : vec3(real(0.0)));
    } else {
        return false;
    }
    return true;
}

// Evaluates whole BSDFs and states of paths. Returns false for any other.
FN bool evaluate_bsdf(uint function, IN(Arguments) a, INOUT(Values) r) {
    if (function == of_lobe_probabilities) {
        vec4 p = lobe_probabilities(material_at(a, 1), above(number_at(a, 0)), LOBES_ALL);
        put3(r, 0, vec3(p.x, p.y, p.z));
        r.y[3] = p.w;
    } else if (function == of_bsdf_albedo) {
        put3(r, 0, bsdf_albedo(material_at(a, 3), vec3_at(a, 0), small_at(a, 17) != 0u, LOBES_ALL));
    } else if (function == of_bsdf_eval_and_pdf) {
        MaterialRecord m = material_at(a, 6);
        real pdf;
        put3(r, 0,
             bsdf_eval_and_pdf(reflection_parameters(m), vec3_at(a, 0), vec3_at(a, 3), LOBES_ALL,
                               lobe_probabilities(m, above(number_at(a, 2)), LOBES_ALL), pdf));
        r.y[3] = pdf;
    } else if (function == of_bsdf_eval || function == of_bsdf_pdf) {
        MaterialRecord m = material_at(a, 6);
        vec3 wo = vec3_at(a, 0);
        vec3 wi = vec3_at(a, 3);
        uint lobes = small_at(a, 20);
        real pdf;
        vec3 f = bsdf_eval_and_pdf(reflection_parameters(m), wo, wi, lobes,
                                   lobe_probabilities(m, wo, lobes), pdf);
        // The glossy lobe alone may scale powers that are subnormal, which devices may flush to 0.
        const real negligible = real(1e-30);
        if (function == of_bsdf_eval) {
            vec3 alone = bsdf_eval(m, wo, wi, lobes);
            put3(r, 0, alone + vec3(negligible));
            r.y[3] = must_be(alone == f ? real(1.0) : real(0.0), real(1.0));
        } else {
            real alone = bsdf_pdf(m, wo, wi, lobes);
            r.y[0] = alone + negligible;
            r.y[1] = must_be(alone == pdf ? real(1.0) : real(0.0), real(1.0));
        }
    } else if (function == of_rough_clear) {
        real pdf;
        put3(r, 0,
             rough_clear_eval_and_pdf(material_at(a, 6), vec3_at(a, 0), vec3_at(a, 3),
                                      small_at(a, 20) != 0u, pdf));
        r.y[3] = pdf;
    } else if (function == of_followed_lobes) {
        MaterialRecord m = material_at(a, 1);
        uint followed = followed_lobes(m, number_at(a, 0));
        r.y[0] = real(followed);
        r.y[1] = real(must_be(estimated_lobes(m, number_at(a, 0)), bsdf_lobes(m) - followed));
        r.y[2] = is_lambertian(m) ? real(1.0) : real(0.0);
    } else if (function == of_path_state) {
        uint state = 0u;
        for (uint i = 0u; i < small_at(a, 0); ++i) {
            state = state_after(state, ((small_at(a, 1) >> i) & 1u) != 0u);
        }
        put_word(r, 0, must_be(state, path_by_vertices(small_at(a, 0), small_at(a, 1)).x));
        r.y[2] = real(
            must_be(layer_of_emission(state), path_by_vertices(small_at(a, 0), small_at(a, 1)).y));
    } else if (function == of_bsdf_sample) {
        BsdfSample sample_;
        bool scattered = bsdf_sample(material_at(a, 6), vec3_at(a, 0), small_at(a, 20) != 0u,
                                     LOBES_ALL, vec4(a.x[3], a.x[4], a.x[5], real(0.0)), sample_);
        r.y[0] = scattered ? real(sample_.lobe) : real(0.0);
        put3(r, 1, scattered ? sample_.wi : vec3(real(0.0)));
        put3(r, 4, sample_.weight);
        // Skip the density: it belongs to the rounded direction, and bsdf_eval covers it.
        r.y[7] = scattered ? sample_.eta_scale : real(0.0);
    } else {
        return false;
    }
    return true;
}

// Evaluates functions of rays, surfaces and cameras. Returns false for any other.
FN bool evaluate_rays(uint function, IN(Arguments) a, INOUT(Values) r) {
    real s;
    if (function == of_ray_shear) {
        RayShear shear = ray_shear(vec3_at(a, 0));
        r.y[0] = real(shear.axis);
        r.y[1] = shear.x;
        r.y[2] = shear.y;
        r.y[3] = shear.z;
    } else if (function == of_intersect_triangle || function == of_intersect_sliver) {
        real t, u, v;
        bool hit =
            intersect_triangle(ray_shear(vec3_at(a, 3)), vec3_at(a, 0), vec3_at(a, 6),
                               vec3_at(a, 9), vec3_at(a, 12), real(0.0), real(1e30), t, u, v);
        r.y[0] = hit ? real(1.0) : real(0.0);
        r.y[1] = hit ? t : real(0.0);
        r.y[2] = hit ? u : real(0.0);
        r.y[3] = hit ? v : real(0.0);
        if (function == of_intersect_sliver) {
            // The place in units of the sliver's length, along which t is as uncertain as u and v.
            unit_and_length(vec3_at(a, 9) - vec3_at(a, 6), s);
            r.y[1] = r.y[1] / s;
        }
    } else if (function == of_normalize_or) {
        put3(r, 0, normalize_or(vec3_at(a, 0), vec3_at(a, 3)));
    } else if (function == of_box_reach) {
        r.y[0] = box_reach(vec3_at(a, 0), vec3_at(a, 3), vec3_at(a, 6));
    } else if (function == of_hit_point) {
        vec3 error;
        put3(r, 0,
             hit_point(vec3_at(a, 2), vec3_at(a, 5), vec3_at(a, 8), number_at(a, 0),
                       number_at(a, 1), error));
    } else if (function == of_offset_ray_origin) {
        put3(r, 0, offset_ray_origin(vec3_at(a, 0), vec3_at(a, 3), vec3_at(a, 6), vec3_at(a, 9)));
    } else if (function == of_make_surface) {
        Surface surface =
            make_surface(smooth_triangle_at(a, 5), number_at(a, 0), number_at(a, 1), vec3_at(a, 2));
        r.y[0] = surface.front ? real(1.0) : real(0.0);
        put3(r, 1, surface.position);
        put3(r, 4, surface.geometric_normal);
        put3(r, 7, surface.shading_normal);
        r.y[10] = surface.shading_normal == surface.geometric_normal ? real(1.0) : real(0.0);
    } else if (function == of_camera_ray) {
        CameraRecord camera;
        camera.origin_x = a.x[2];
        camera.origin_y = a.x[3];
        camera.origin_z = a.x[4];
        camera.forward_x = a.x[5];
        camera.forward_y = a.x[6];
        camera.forward_z = a.x[7];
        camera.across_x = a.x[8];
        camera.across_y = a.x[9];
        camera.across_z = a.x[10];
        camera.down_x = a.x[11];
        camera.down_y = a.x[12];
        camera.down_z = a.x[13];
        camera.origin_share = a.x[14];
        camera.lens_radius = camera.inverse_focus = camera.pad = float32(0.0);
        vec3 origin, direction;
        camera_ray(camera, number_at(a, 0), number_at(a, 1), vec2(real(0.0)), origin, direction);
        put3(r, 0, origin);
        put3(r, 3, direction);
    } else {
        return false;
    }
    return true;
}

FN Values evaluate_scatter(uint function, IN(Arguments) a) {
    Values r = no_values();
    if (!evaluate_lobes(function, a, r) && !evaluate_bsdf(function, a, r)) {
        evaluate_rays(function, a, r);
    }
    return r;
}

ARGAND_SHARED_END

#endif
