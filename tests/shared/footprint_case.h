// The whole chain from emission to a record and a query, as one function that host and device both
// run.
#ifndef ARGAND_TEST_FOOTPRINT_CASE_H
#define ARGAND_TEST_FOOTPRINT_CASE_H

#include "shared/footprint.h"
#include "shared/light_differential.h"
#include "shared/photon.h"
#include "shared/random.h"

ARGAND_SHARED_BEGIN

struct FootprintResult {
    PhotonRecord photon;
    uint a_xy, a_zs, b_xy, b_zs;
    float32 extent_x, extent_y, extent_z, area;
    float32 weight, spread_u, spread_v, scale;
};

FN FootprintResult footprint_case(IN(LightRecord) l, uint i) {
    Sphere bounds;
    bounds.center = vec3(real(0.0));
    bounds.radius = real(2.0);
    EmittedPhoton p;
    light_emit(l, all_light_kinds, bounds, random4(61u, i, 0u, 0u), random4(61u, i, 0u, 1u), p);
    vec3 direction = p.direction;
    PhotonDifferential d =
        light_differential(l, all_light_kinds, p, bounds.radius, real(1e4), real(1e5));
    vec4 u = random4(61u, i, 1u, 0u);
    vec3 n = sample_sphere(vec2(u.x, u.y));
    n = dot3(n, direction) > real(0.0) ? -n : n;
    transfer_differential(d, direction, real(0.1) + u.z, n);
    roulette_differential(d, real(0.1) + real(0.9) * u.w);
    // A triangle around n with different normals at its vertices.
    Frame f = make_frame(n);
    SmoothTriangle t;
    t.v0 = vec3(real(0.0));
    t.v1 = f.x;
    t.v2 = f.x * real(0.3) + f.y * real(0.4);
    t.n0 = n;
    t.n1 = n + f.x * real(0.2);
    t.n2 = n - f.y * real(0.3);
    NormalDifferential smooth_normal;
    real size;
    smooth_normal.n =
        unit_and_length(t.n0 * real(0.5) + t.n1 * real(0.25) + t.n2 * real(0.25), size);
    vec2 b = vec2(real(0.25), real(0.25));
    smooth_normal.dn_du = shading_normal_change(t, b, smooth_normal.n, d.dp_du);
    smooth_normal.dn_dv = shading_normal_change(t, b, smooth_normal.n, d.dp_dv);
    uint event = i % 6u;
    vec3 next = to_world(f, sample_cosine_hemisphere(vec2(u.z, u.w)));
    if (event == 0u) {
        reflect_differential(d, direction, smooth_normal);
    } else if (event == 1u) {
        refract_differential(d, direction, smooth_normal,
                             u.z < real(0.5) ? real(1.5) : real(0.66666666666666667));
    } else if (event == 2u) {
        gloss_differential(d, direction, next, smooth_normal, real(1e4), real(0.5));
    } else {
        d = reemitted_differential(d, f, next, real(1e4), event - 3u);
    }
    FootprintResult r;
    r.spread_u = float32(sqrt(dot3(d.dd_du, d.dd_du)));
    r.spread_v = float32(sqrt(dot3(d.dd_dv, d.dd_dv)));
    transfer_differential(d, next, u.y, n);
    FootprintTuning tuning;
    tuning.smoothing = real(3.0);
    tuning.caustic_smoothing = real(5.0);
    tuning.largest = real(0.1);
    tuning.flatness = real(0.4);
    tuning.exponent = real(0.16666666666666666667);
    FootprintScale s = make_footprint_scale(real(1e5), real(1e4), real(2.0), tuning);
    s.principal_axes = i % 2u;
    Footprint footprint = make_footprint(d, n, event < 2u, s);
    r.photon.x = float32(p.origin.x);
    r.photon.y = float32(p.origin.y);
    r.photon.z = float32(p.origin.z);
    r.photon.normal = pack_photon_normal(n, event < 2u);
    r.photon.flux_r = float32(p.flux.x);
    r.photon.flux_g = float32(p.flux.y);
    r.photon.flux_b = float32(p.flux.z);
    r.photon.direction = pack_unit(-direction);
    FootprintDuals duals = footprint_duals(footprint, n);
    uvec2 packed_a = pack_dual(duals.a);
    uvec2 packed_b = pack_dual(duals.b);
    r.a_xy = packed_a.x;
    r.a_zs = packed_a.y;
    r.b_xy = packed_b.x;
    r.b_zs = packed_b.y;
    duals.a = unpack_dual(packed_a.x, packed_a.y);
    duals.b = unpack_dual(packed_b.x, packed_b.y);
    vec3 packed_normal = unpack_photon_normal(r.photon.normal);
    vec3 extent = footprint_extent(footprint_of_duals(duals, packed_normal, real(0.4)));
    r.extent_x = float32(extent.x);
    r.extent_y = float32(extent.y);
    r.extent_z = float32(extent.z);
    r.area = float32(footprint_area(footprint));
    vec3 offset = footprint.u * real(0.3) - footprint.v * real(0.4) + footprint.w * real(0.2);
    r.weight = float32(
        footprint_weight(duals, packed_normal, smooth_normal.n, offset, real(0.4), i % 4u < 2u));
    r.scale = s.diffuse;
    return r;
}

ARGAND_SHARED_END

#endif
