// Functions of lights, differentials and footprints.
#ifndef ARGAND_TEST_LIGHT_FUNCTIONS_H
#define ARGAND_TEST_LIGHT_FUNCTIONS_H

#include "arguments.h"
#include "shared/aim.h"
#include "shared/differential_record.h"
#include "shared/footprint.h"
#include "shared/light_differential.h"
#include "shared/triangle_piece.h"

ARGAND_SHARED_BEGIN

CONSTANT uint of_spot_falloff = 60u;
CONSTANT uint of_spot_solid_angles = 61u;
CONSTANT uint of_light_normal = 62u;
CONSTANT uint of_light_power = 63u;
CONSTANT uint of_emitter_density = 64u;
CONSTANT uint of_descend_aim = 90u;
CONSTANT uint of_light_sample = 65u;
CONSTANT uint of_light_emit = 66u;
CONSTANT uint of_photon_spacing = 67u;
CONSTANT uint of_direction_axes = 68u;
CONSTANT uint of_parallelogram_side = 69u;
CONSTANT uint of_transferred_offset = 70u;
CONSTANT uint of_reflected_spread = 71u;
CONSTANT uint of_refracted_spread = 72u;
CONSTANT uint of_roulette_differential = 73u;
CONSTANT uint of_independent_spread = 74u;
CONSTANT uint of_reemitted_differential = 75u;
CONSTANT uint of_gloss_differential = 76u;
CONSTANT uint of_shading_normal_change = 77u;
CONSTANT uint of_light_differential = 78u;
CONSTANT uint of_footprint_scale = 79u;
CONSTANT uint of_make_principal = 80u;
CONSTANT uint of_make_footprint = 81u;
CONSTANT uint of_footprint_area = 82u;
CONSTANT uint of_footprint_duals = 83u;
CONSTANT uint of_footprint_of_duals = 84u;
CONSTANT uint of_footprint_extent = 85u;
CONSTANT uint of_footprint_weight = 86u;
CONSTANT uint of_pack_dual = 87u;
CONSTANT uint of_spot_ramp = 88u;
CONSTANT uint of_sample_spot = 89u;
CONSTANT uint of_transfer_differential = 91u;
CONSTANT uint of_reflect_differential = 92u;
CONSTANT uint of_refract_differential = 93u;
CONSTANT uint of_differential_record = 94u;
CONSTANT uint of_unpack_dual = 95u;
CONSTANT uint of_dual_read = 96u;
CONSTANT uint of_light_emit_aimed = 97u;
CONSTANT uint of_triangle_piece = 98u;
CONSTANT uint of_splat = 99u;
CONSTANT uint end_of_lights = 100u;

FN LightRecord light_at(IN(Arguments) a, int k, uint kind, uint double_sided) {
    LightRecord l;
    l.x = a.x[k];
    l.y = a.x[k + 1];
    l.z = a.x[k + 2];
    l.kind = kind;
    l.r = a.x[k + 3];
    l.g = a.x[k + 4];
    l.b = a.x[k + 5];
    l.cos_inner = a.x[k + 6];
    l.dx = a.x[k + 7];
    l.dy = a.x[k + 8];
    l.dz = a.x[k + 9];
    l.cos_outer = a.x[k + 10];
    l.ex = a.x[k + 11];
    l.ey = a.x[k + 12];
    l.ez = a.x[k + 13];
    l.triangle_and_sides = double_sided;
    return l;
}

FN PhotonDifferential differential_at(IN(Arguments) a, int k) {
    PhotonDifferential d;
    d.dp_du = vec3_at(a, k);
    d.dp_dv = vec3_at(a, k + 3);
    d.dd_du = vec3_at(a, k + 6);
    d.dd_dv = vec3_at(a, k + 9);
    return d;
}

FN NormalDifferential normal_differential_at(IN(Arguments) a, int k) {
    NormalDifferential normal;
    normal.n = vec3_at(a, k);
    normal.dn_du = vec3_at(a, k + 3);
    normal.dn_dv = vec3_at(a, k + 6);
    return normal;
}

FN Values differential_values(IN(PhotonDifferential) d) {
    Values r = no_values();
    put3(r, 0, d.dp_du);
    put3(r, 3, d.dp_dv);
    put3(r, 6, d.dd_du);
    put3(r, 9, d.dd_dv);
    return r;
}

// Smoothing, exponent and the other parameters are the engine's defaults.
FN FootprintScale some_footprint_scale(real photons, real length, uint principal_axes) {
    FootprintTuning tuning;
    tuning.smoothing = real(3.0);
    tuning.caustic_smoothing = real(5.0);
    tuning.largest = real(0.1);
    tuning.flatness = real(0.4);
    tuning.exponent = real(0.16666666666666666667);
    FootprintScale s = make_footprint_scale(photons, real(1e4), length, tuning);
    s.principal_axes = principal_axes;
    return s;
}

FN Footprint footprint_at(IN(Arguments) a, int k) {
    Footprint f;
    f.u = vec3_at(a, k);
    f.v = vec3_at(a, k + 3);
    f.w = vec3_at(a, k + 6);
    return f;
}

// Evaluates functions of lights and emitted photons. Returns false for any other.
FN bool evaluate_light(uint function, IN(Arguments) a, INOUT(Values) r) {
    real s, t;
    if (function == of_spot_falloff) {
        r.y[0] = spot_falloff(number_at(a, 0), number_at(a, 1), number_at(a, 2));
    } else if (function == of_spot_ramp) {
        r.y[0] = spot_ramp(number_at(a, 0), number_at(a, 1));
    } else if (function == of_sample_spot) {
        put3(r, 0,
             sample_spot(light_at(a, 6, light_spot, 0u), vec4(a.x[0], a.x[1], a.x[2], a.x[3]),
                         vec2_at(a, 4)));
    } else if (function == of_spot_solid_angles) {
        r.y[0] = spot_solid_angles(number_at(a, 0), number_at(a, 1), s, t);
        r.y[1] = s;
    } else if (function == of_light_normal) {
        put3(r, 0, light_normal(light_at(a, 0, light_triangle, 0u), s));
        r.y[3] = s;
    } else if (function == of_light_power) {
        put3(r, 0,
             light_power(light_at(a, 1, small_at(a, 15), small_at(a, 16)), all_light_kinds,
                         number_at(a, 0)));
    } else if (function == of_emitter_density) {
        r.y[0] =
            emitter_density(number_at(a, 0), number_at(a, 1), number_at(a, 2), number_at(a, 3));
    } else if (function == of_descend_aim) {
        AimNode node;
        node.axis = 2u;
        node.child = 0u;
        node.cut = float32(number_at(a, 4));
        node.share = float32(number_at(a, 5));
        AimedNumbers aimed =
            begin_aim(vec4(number_at(a, 0), number_at(a, 1), number_at(a, 2), number_at(a, 3)));
        descend_aim(node, aimed);
        vec4 u = end_aim(aimed);
        r.y[0] = u.x;
        r.y[1] = u.z;
        r.y[2] = aimed.concentration;
    } else if (function == of_light_sample) {
        LightSample l;
        bool lit = light_sample(light_at(a, 5, small_at(a, 19), small_at(a, 20)), all_light_kinds,
                                vec3_at(a, 0), vec2_at(a, 3), l);
        r.y[0] = lit ? real(1.0) : real(0.0);
        put3(r, 1, lit ? l.wi : vec3(real(0.0)));
        put3(r, 4, lit ? l.radiance : vec3(real(0.0)));
        r.y[7] = lit ? l.pdf : real(0.0);
    } else if (function == of_light_emit) {
        Sphere bounds;
        bounds.center = vec3(real(0.0));
        bounds.radius = number_at(a, 6);
        EmittedPhoton p;
        bool emitted = light_emit(light_at(a, 8, small_at(a, 22), small_at(a, 23)), all_light_kinds,
                                  bounds, vec4(a.x[0], a.x[1], a.x[2], a.x[3]),
                                  vec4(a.x[4], a.x[5], real(0.0), real(0.0)), p);
        r.y[0] = emitted ? real(1.0) : real(0.0);
        // On triangles, offset_ray_origin moves the origin by a bound of this precision's rounding
        // errors, so skip it.
        put3(r, 1, small_at(a, 22) != light_triangle ? p.origin : vec3(real(0.0)));
        put3(r, 4, p.direction);
        put3(r, 7, p.flux);
    } else if (function == of_light_emit_aimed) {
        Sphere bounds;
        bounds.center = vec3(real(0.0));
        bounds.radius = number_at(a, 6);
        Targets targets;
        targets.spheres[0] = vec4(real(0.5), real(0.25), real(-0.25), real(0.0625)) * bounds.radius;
        targets.spheres[1] = vec4(real(-0.5), real(0.0), real(0.5), real(0.25)) * bounds.radius;
        targets.spheres[2] = targets.spheres[3] = vec4(real(0.0));
        targets.count = 2u;
        targets.share = real(0.25);
        targets.view = vec4(real(0.0), real(0.5), real(0.25), real(0.125)) * bounds.radius;
        targets.view_share = real(0.25);
        EmittedPhoton p;
        bool emitted =
            light_emit_aimed(light_at(a, 8, small_at(a, 22), small_at(a, 23)), all_light_kinds,
                             bounds, targets, vec4(a.x[0], a.x[1], a.x[2], a.x[3]),
                             vec4(a.x[4], a.x[5], real(0.0), real(0.0)), number_at(a, 7), p);
        r.y[0] = emitted ? real(1.0) : real(0.0);
        put3(r, 1, small_at(a, 22) != light_triangle ? p.origin : vec3(real(0.0)));
        put3(r, 4, p.direction);
    } else if (function == of_triangle_piece) {
        TrianglePiece piece = triangle_piece(small_at(a, 0));
        r.y[0] = piece.a.x;
        r.y[1] = piece.a.y;
        r.y[2] = piece.b.x;
        r.y[3] = piece.b.y;
        r.y[4] = piece.c.x;
        r.y[5] = piece.c.y;
    } else {
        return false;
    }
    return true;
}

// Evaluates differentials of photons. Returns false for any other.
FN bool evaluate_differential(uint function, IN(Arguments) a, INOUT(Values) r) {
    if (function == of_transfer_differential) {
        PhotonDifferential d = differential_at(a, 7);
        transfer_differential(d, vec3_at(a, 0), number_at(a, 3), vec3_at(a, 4));
        r = differential_values(d);
    } else if (function == of_reflect_differential) {
        PhotonDifferential d = differential_at(a, 12);
        reflect_differential(d, vec3_at(a, 0), normal_differential_at(a, 3));
        r = differential_values(d);
    } else if (function == of_refract_differential) {
        PhotonDifferential d = differential_at(a, 13);
        refract_differential(d, vec3_at(a, 0), normal_differential_at(a, 3), number_at(a, 12));
        r = differential_values(d);
    } else if (function == of_photon_spacing) {
        r.y[0] = photon_spacing(number_at(a, 0), number_at(a, 1));
    } else if (function == of_direction_axes) {
        vec3 u, v;
        direction_axes(make_frame(vec3_at(a, 0)), vec3_at(a, 3), u, v);
        put3(r, 0, u);
        put3(r, 3, v);
    } else if (function == of_parallelogram_side) {
        r.y[0] = parallelogram_side(vec3_at(a, 0), vec3_at(a, 3));
    } else if (function == of_transferred_offset) {
        put3(r, 0,
             transferred_offset(vec3_at(a, 0), vec3_at(a, 3), vec3_at(a, 6), number_at(a, 9),
                                vec3_at(a, 10)));
    } else if (function == of_reflected_spread) {
        put3(r, 0, reflected_spread(vec3_at(a, 0), vec3_at(a, 3), vec3_at(a, 6), vec3_at(a, 9)));
    } else if (function == of_refracted_spread) {
        put3(r, 0,
             refracted_spread(vec3_at(a, 0), vec3_at(a, 3), vec3_at(a, 6), vec3_at(a, 9),
                              number_at(a, 12)));
    } else if (function == of_roulette_differential) {
        PhotonDifferential d = differential_at(a, 1);
        roulette_differential(d, number_at(a, 0));
        r = differential_values(d);
    } else if (function == of_independent_spread) {
        PhotonDifferential d = differential_at(a, 4);
        add_independent_spread(d, vec3_at(a, 0), number_at(a, 3));
        r = differential_values(d);
    } else if (function == of_reemitted_differential) {
        r = differential_values(reemitted_differential(differential_at(a, 7),
                                                       make_frame(vec3_at(a, 0)), vec3_at(a, 3),
                                                       number_at(a, 6), small_at(a, 19)));
    } else if (function == of_gloss_differential) {
        PhotonDifferential d = differential_at(a, 14);
        NormalDifferential normal;
        normal.n = vec3_at(a, 6);
        normal.dn_du = vec3_at(a, 9);
        normal.dn_dv = vec3(real(0.0));
        gloss_differential(d, vec3_at(a, 0), vec3_at(a, 3), normal, number_at(a, 12),
                           number_at(a, 13));
        r = differential_values(d);
    } else if (function == of_shading_normal_change) {
        SmoothTriangle triangle = smooth_triangle_at(a, 0);
        real size;
        vec3 shading =
            unit_and_length(triangle.n0 * (real(1.0) - number_at(a, 18) - number_at(a, 19)) +
                                triangle.n1 * number_at(a, 18) + triangle.n2 * number_at(a, 19),
                            size);
        put3(r, 0, shading_normal_change(triangle, vec2_at(a, 18), shading, vec3_at(a, 20)));
    } else if (function == of_light_differential) {
        EmittedPhoton p;
        p.direction = vec3_at(a, 0);
        p.normal = vec3_at(a, 3);
        p.concentration = real(1.0);
        r = differential_values(light_differential(light_at(a, 8, small_at(a, 22), small_at(a, 23)),
                                                   all_light_kinds, p, number_at(a, 6),
                                                   number_at(a, 7), number_at(a, 7)));
    } else if (function == of_differential_record) {
        PhotonDifferential d = load_differential(differential_record(differential_at(a, 0)));
        r = must_be(differential_values(d), differential_values(differential_at(a, 0)));
    } else {
        return false;
    }
    return true;
}

// Evaluates footprints. Returns false for any other.
FN bool evaluate_footprint(uint function, IN(Arguments) a, INOUT(Values) r) {
    if (function == of_footprint_scale) {
        FootprintScale scale = some_footprint_scale(number_at(a, 0), number_at(a, 1), 0u);
        r.y[0] = real(scale.spacing);
        r.y[1] = real(scale.diffuse);
        r.y[2] = real(scale.caustic);
        r.y[3] = real(scale.radius_max);
    } else if (function == of_make_principal) {
        vec3 u = vec3_at(a, 0);
        vec3 v = vec3_at(a, 3);
        make_principal(u, v);
        put3(r, 0, u);
        put3(r, 3, v);
    } else if (function == of_make_footprint) {
        PhotonDifferential d = no_differential();
        d.dp_du = vec3_at(a, 0);
        d.dp_dv = vec3_at(a, 3);
        Footprint f = make_footprint(
            d, vec3_at(a, 6), small_at(a, 11) != 0u,
            some_footprint_scale(number_at(a, 9), number_at(a, 10), small_at(a, 12)));
        // If both axes are clamped, either may come first; the ellipsoid is the same.
        put3(r, 0, footprint_extent(f));
        r.y[3] = footprint_area(f);
    } else if (function == of_splat) {
        vec3 normal = vec3_at(a, 3);
        FootprintScale scale = splat_scale(vec2(number_at(a, 7), number_at(a, 8)), number_at(a, 9),
                                           vec2(real(0.25), real(16.0)), real(0.5));
        Footprint f = make_footprint(splat_differential(vec3_at(a, 0), number_at(a, 6), normal),
                                     normal, small_at(a, 10) != 0u, scale);
        put3(r, 0, footprint_extent(f));
    } else if (function == of_footprint_area) {
        r.y[0] = footprint_area(footprint_at(a, 0));
    } else if (function == of_footprint_duals) {
        FootprintDuals duals = footprint_duals(footprint_at(a, 0), vec3_at(a, 9));
        put3(r, 0, duals.a);
        put3(r, 3, duals.b);
    } else if (function == of_footprint_of_duals) {
        FootprintDuals duals;
        duals.a = vec3_at(a, 0);
        duals.b = vec3_at(a, 3);
        Footprint f = footprint_of_duals(duals, vec3_at(a, 6), number_at(a, 9));
        put3(r, 0, f.u);
        put3(r, 3, f.v);
        put3(r, 6, f.w);
    } else if (function == of_footprint_extent) {
        put3(r, 0, footprint_extent(footprint_at(a, 0)));
    } else if (function == of_footprint_weight) {
        FootprintDuals duals;
        duals.a = vec3_at(a, 0);
        duals.b = vec3_at(a, 3);
        r.y[0] = footprint_weight(duals, vec3_at(a, 6), vec3_at(a, 9), vec3_at(a, 12),
                                  number_at(a, 15), false);
    } else if (function == of_pack_dual) {
        uvec2 packed = pack_dual(vec3_at(a, 0));
        put_word(r, 0, packed.x);
        put_word(r, 2, packed.y);
    } else if (function == of_unpack_dual) {
        put3(r, 0, unpack_dual(word_at(a, 0), word_at(a, 2)));
    } else if (function == of_dual_read) {
        uvec2 packed = pack_dual(vec3_at(a, 0));
        put3(r, 0, must_be(unpack_dual(packed.x, packed.y), vec3_at(a, 0)));
    } else {
        return false;
    }
    return true;
}

FN Values evaluate_lights(uint function, IN(Arguments) a) {
    Values r = no_values();
    if (!evaluate_light(function, a, r) && !evaluate_differential(function, a, r)) {
        evaluate_footprint(function, a, r);
    }
    return r;
}

ARGAND_SHARED_END

#endif
