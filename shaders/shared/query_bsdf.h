#ifndef ARGAND_SHARED_QUERY_BSDF_H
#define ARGAND_SHARED_QUERY_BSDF_H

#include "shared/bsdf.h"
#include "shared/query_record.h"

ARGAND_SHARED_BEGIN

// direction: towards the eye; both vectors are packed by pack_unit.
FN QueryBsdfRecord query_bsdf(IN(ReflectionParameters) r, uint direction, uint shading_normal) {
    QueryBsdfRecord q;
    q.base_r = float32(r.base_color.x);
    q.base_g = float32(r.base_color.y);
    q.base_b = float32(r.base_color.z);
    q.opaque_share = float32(r.opaque_share);
    q.f0_r = float32(r.f0.x);
    q.f0_g = float32(r.f0.y);
    q.f0_b = float32(r.f0.z);
    q.f90 = float32(r.f90);
    q.metal_share = float32(r.metal_share);
    q.layer_share = float32(r.layer_share);
    q.alpha_across = float32(r.alpha_across);
    q.anisotropy_x = float32(r.anisotropy.x);
    q.anisotropy_y = float32(r.anisotropy.y);
    q.exponent = float32(r.exponent);
    q.coat = float32(r.coat);
    q.coat_alpha = float32(r.coat_alpha);
    q.coat_normal_x = float32(r.coat_normal.x);
    q.coat_normal_y = float32(r.coat_normal.y);
    q.coat_normal_z = float32(r.coat_normal.z);
    q.film = float32(r.film);
    q.film_ior = float32(r.film_ior);
    q.film_thickness = float32(r.film_thickness);
    q.sheen_r = float32(r.sheen.x);
    q.sheen_g = float32(r.sheen.y);
    q.sheen_b = float32(r.sheen.z);
    q.sheen_most = float32(r.sheen_most);
    q.sheen_alpha = float32(r.sheen_alpha);
    q.direction = direction;
    q.shading_normal = shading_normal;
    return q;
}

// Leaves `absent` 0, which excludes no lobe; the kernel sets it, as load_material() does.
FN ReflectionParameters reflection_parameters(IN(QueryBsdfRecord) q) {
    ReflectionParameters r;
    r.base_color = vec3(q.base_r, q.base_g, q.base_b);
    r.f0 = vec3(q.f0_r, q.f0_g, q.f0_b);
    r.f90 = real(q.f90);
    r.opaque_share = real(q.opaque_share);
    r.metal_share = real(q.metal_share);
    r.layer_share = real(q.layer_share);
    r.alpha_across = real(q.alpha_across);
    r.anisotropy = vec2(real(q.anisotropy_x), real(q.anisotropy_y));
    r.alpha = mean_alpha(0u, r.alpha_across, r.anisotropy);
    r.exponent = real(q.exponent);
    r.coat = real(q.coat);
    r.coat_alpha = real(q.coat_alpha);
    r.coat_normal = vec3(q.coat_normal_x, q.coat_normal_y, q.coat_normal_z);
    r.film = real(q.film);
    r.film_ior = real(q.film_ior);
    r.film_thickness = real(q.film_thickness);
    r.sheen = vec3(q.sheen_r, q.sheen_g, q.sheen_b);
    r.sheen_most = real(q.sheen_most);
    r.sheen_alpha = real(q.sheen_alpha);
    r.absent = 0u;
    return r;
}

ARGAND_SHARED_END

#endif
