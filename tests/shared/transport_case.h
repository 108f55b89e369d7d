// Calls functions of every kind in shaders/shared, as one function that host and device both run.
#ifndef ARGAND_TEST_TRANSPORT_CASE_H
#define ARGAND_TEST_TRANSPORT_CASE_H

#include "shared/bsdf.h"
#include "shared/camera.h"
#include "shared/fixed_point.h"
#include "shared/lights.h"
#include "shared/morton.h"
#include "shared/random.h"

ARGAND_SHARED_BEGIN

// Laid out in 16-byte lanes.
struct TransportResult {
    float32 wi_x, wi_y, wi_z, pdf;
    float32 weight_x, weight_y, weight_z, eta_scale;
    float32 f_x, f_y, f_z, f_pdf;
    float32 radiance_x, radiance_y, radiance_z, light_pdf;
    float32 origin_x, origin_y, origin_z, distance;
    float32 direction_x, direction_y, direction_z, flux;
    float32 t, u, v, reach;
    uint lobe, hit, code, packed;
    uint random, fixed_low, fixed_high, pad;
};

FN TransportResult transport_case(IN(MaterialRecord) m, IN(LightRecord) l, IN(CameraRecord) c,
                                  uint i) {
    TransportResult r;
    vec4 u = random4(5u, i, 0u, 0u);
    vec4 v = random4(5u, i, 1u, 0u);
    vec4 x = random4(5u, i, 2u, 0u);
    vec3 eye, direction;
    camera_ray(c, u.x * real(64.0), u.y * real(48.0), vec2(v.x, v.y), eye, direction);

    vec3 wo = sample_cosine_hemisphere(vec2(u.z, u.w));
    BsdfSample s;
    bool scattered = bsdf_sample(m, wo, (i & 1u) != 0u, LOBES_ALL, v, s);
    r.wi_x = s.wi.x;
    r.wi_y = s.wi.y;
    r.wi_z = s.wi.z;
    r.pdf = s.pdf;
    r.weight_x = s.weight.x;
    r.weight_y = s.weight.y;
    r.weight_z = s.weight.z;
    r.eta_scale = s.eta_scale;
    r.lobe = scattered ? s.lobe : 0u;
    vec3 wi = sample_cosine_hemisphere(vec2(x.x, x.y));
    vec3 f = bsdf_eval(m, wo, wi, LOBES_ALL);
    r.f_x = f.x;
    r.f_y = f.y;
    r.f_z = f.z;
    r.f_pdf = bsdf_pdf(m, wo, wi, LOBES_ALL);

    LightSample sample_;
    bool lit = light_sample(l, all_light_kinds, eye, vec2(x.z, x.w), sample_);
    r.radiance_x = lit ? sample_.radiance.x : real(0.0);
    r.radiance_y = lit ? sample_.radiance.y : real(0.0);
    r.radiance_z = lit ? sample_.radiance.z : real(0.0);
    r.light_pdf = lit ? sample_.pdf : real(0.0);
    r.distance = lit ? sample_.distance : real(0.0);
    Sphere bounds;
    bounds.center = vec3(real(0.0));
    bounds.radius = real(4.0);
    EmittedPhoton photon;
    light_emit(l, all_light_kinds, bounds, v, x, photon);
    r.origin_x = photon.origin.x;
    r.origin_y = photon.origin.y;
    r.origin_z = photon.origin.z;
    r.direction_x = photon.direction.x;
    r.direction_y = photon.direction.y;
    r.direction_z = photon.direction.z;
    r.flux = photon.flux.x;

    vec3 a = vec3(l.x, l.y, l.z);
    vec3 b = vec3(l.dx, l.dy, l.dz);
    vec3 d = vec3(l.ex, l.ey, l.ez);
    vec3 towards = a * u.x + b * u.y + d * (real(1.0) - u.x - u.y) - eye;
    real length_;
    towards = unit_and_length(towards, length_);
    real t, bu, bv;
    bool hit =
        intersect_triangle(ray_shear(towards), eye, a, b, d, real(0.0), real(1e30), t, bu, bv);
    r.t = t;
    r.u = bu;
    r.v = bv;
    r.reach = box_reach(eye, min(a, min(b, d)), max(a, max(b, d)));
    r.hit = hit ? 1u : 0u;
    // Functions whose results every device computes to the bit.
    r.code = morton30(vec3(u.x, u.y, u.z), vec3(real(0.0)), vec3(real(1.0)));
    r.packed = unpack_unit(uint(i) * 2654435761u).z >= real(0.0) ? 1u : 0u;
    uvec4 words = pcg4d(uvec4(i, 1u, 2u, 3u));
    r.random = words.w;
    uvec2 sum = fixed_add(uvec2(words.x, words.y), uvec2(words.z, words.w));
    r.fixed_low = sum.x;
    r.fixed_high = sum.y;
    r.pad = 0u;
    return r;
}

ARGAND_SHARED_END

#endif
