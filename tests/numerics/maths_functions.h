// Elementary functions, vectors, frames, samplers, codes and random numbers.
#ifndef ARGAND_TEST_MATHS_FUNCTIONS_H
#define ARGAND_TEST_MATHS_FUNCTIONS_H

#include "arguments.h"
#include "shared/fixed_point.h"
#include "shared/frame.h"
#include "shared/morton.h"
#include "shared/photon.h"
#include "shared/query_cell.h"
#include "shared/sampling.h"

ARGAND_SHARED_BEGIN

CONSTANT uint of_sincos_2pi = 0u;
CONSTANT uint of_log_complement = 1u;
CONSTANT uint of_exp_negative = 2u;
CONSTANT uint of_exp_complement = 3u;
CONSTANT uint of_pow_real = 4u;
CONSTANT uint of_unit_and_length = 5u;
CONSTANT uint of_dot3 = 6u;
CONSTANT uint of_cross3 = 7u;
CONSTANT uint of_luminance = 8u;
CONSTANT uint of_make_frame = 9u;
CONSTANT uint of_to_world = 10u;
CONSTANT uint of_to_local = 11u;
CONSTANT uint of_sample_disc = 12u;
CONSTANT uint of_sample_cosine_hemisphere = 13u;
CONSTANT uint of_sample_sphere = 14u;
CONSTANT uint of_sample_triangle = 15u;
CONSTANT uint of_pack_unit = 16u;
CONSTANT uint of_unpack_unit = 17u;
CONSTANT uint of_morton_cell = 18u;
CONSTANT uint of_fine_morton_cell = 19u;
CONSTANT uint of_random4 = 20u;
CONSTANT uint of_sobol_random4 = 21u;
CONSTANT uint of_fixed_add = 22u;
CONSTANT uint of_query_cell = 23u;
CONSTANT uint of_direction_cell = 24u;
CONSTANT uint of_pack_photon_normal = 25u;
CONSTANT uint of_unpack_photon_normal = 26u;
CONSTANT uint of_kernel_weight = 27u;
CONSTANT uint of_flux_units = 28u;
CONSTANT uint of_disc_radius = 29u;
CONSTANT uint end_of_maths = 30u;

// Evaluates functions of numbers, vectors and frames. Returns false for any other.
FN bool evaluate_vectors(uint function, IN(Arguments) a, INOUT(Values) r) {
    real s, c;
    if (function == of_sincos_2pi) {
        sincos_2pi(number_at(a, 0), s, c);
        r.y[0] = s;
        r.y[1] = c;
    } else if (function == of_log_complement) {
        r.y[0] = log_complement(number_at(a, 0));
    } else if (function == of_exp_negative) {
        r.y[0] = exp_negative(number_at(a, 0));
    } else if (function == of_exp_complement) {
        r.y[0] = exp_complement(number_at(a, 0));
    } else if (function == of_pow_real) {
        r.y[0] = pow_real(number_at(a, 0), number_at(a, 1));
    } else if (function == of_unit_and_length) {
        put3(r, 0, unit_and_length(vec3_at(a, 0), s));
        r.y[3] = s;
    } else if (function == of_dot3) {
        r.y[0] = dot3(vec3_at(a, 0), vec3_at(a, 3));
    } else if (function == of_cross3) {
        put3(r, 0, cross3(vec3_at(a, 0), vec3_at(a, 3)));
    } else if (function == of_luminance) {
        r.y[0] = luminance(vec3_at(a, 0));
        r.y[1] = mean_component(vec3_at(a, 0));
    } else if (function == of_make_frame) {
        Frame f = make_frame(vec3_at(a, 0));
        put3(r, 0, f.x);
        put3(r, 3, f.y);
    } else if (function == of_to_world) {
        put3(r, 0, to_world(make_frame(vec3_at(a, 0)), vec3_at(a, 3)));
    } else if (function == of_to_local) {
        put3(r, 0, to_local(make_frame(vec3_at(a, 0)), vec3_at(a, 3)));
    } else {
        return false;
    }
    return true;
}

// Evaluates samplers, codes and random numbers. Returns false for any other.
FN bool evaluate_samplers(uint function, IN(Arguments) a, INOUT(Values) r) {
    real s;
    if (function == of_disc_radius) {
        r.y[0] = disc_radius(vec2_at(a, 0), s);
        r.y[1] = s;
    } else if (function == of_sample_disc) {
        vec2 p = sample_disc(vec2_at(a, 0));
        r.y[0] = p.x;
        r.y[1] = p.y;
    } else if (function == of_sample_cosine_hemisphere) {
        vec3 v = sample_cosine_hemisphere(vec2_at(a, 0));
        put3(r, 0, v);
        r.y[3] = v.z;
        r.y[4] = cosine_hemisphere_pdf(v.z);
    } else if (function == of_sample_sphere) {
        put3(r, 0, sample_sphere(vec2_at(a, 0)));
    } else if (function == of_sample_triangle) {
        vec2 b = sample_triangle(vec2_at(a, 0));
        r.y[0] = b.x;
        r.y[1] = b.y;
    } else if (function == of_pack_unit) {
        put_word(r, 0, pack_unit(vec3_at(a, 0)));
    } else if (function == of_unpack_unit) {
        put3(r, 0, unpack_unit(word_at(a, 0)));
    } else if (function == of_morton_cell) {
        r.y[0] = real(morton_cell(number_at(a, 0), number_at(a, 3), number_at(a, 6), real(1024.0)));
    } else if (function == of_fine_morton_cell) {
        r.y[0] =
            real(morton_cell(number_at(a, 0), number_at(a, 3), number_at(a, 6), real(2097152.0)));
    } else if (function == of_random4) {
        vec4 u = random4(word_at(a, 0), word_at(a, 2), word_at(a, 4), small_at(a, 6));
        put3(r, 0, vec3(u.x, u.y, u.z));
        r.y[3] = u.w;
    } else if (function == of_sobol_random4) {
        vec4 u = sobol_random4(word_at(a, 0), word_at(a, 2), word_at(a, 4), small_at(a, 6));
        put3(r, 0, vec3(u.x, u.y, u.z));
        r.y[3] = u.w;
    } else if (function == of_fixed_add) {
        uvec2 sum =
            fixed_add(uvec2(word_at(a, 0), word_at(a, 2)), uvec2(word_at(a, 4), word_at(a, 6)));
        put_word(r, 0, sum.y);
        put_word(r, 2, sum.x);
    } else if (function == of_query_cell) {
        // Jittered by a hash of the point's bits, which are the same in both precisions.
        uvec4 cell = query_cell(vec3_at(a, 5), vec3_at(a, 0), number_at(a, 3), number_at(a, 4));
        r.y[0] = real(int(cell.x) - 0x40000000);
        r.y[1] = real(int(cell.y) - 0x40000000);
        r.y[2] = real(int(cell.z) - 0x40000000);
        r.y[3] = real(cell.w);
    } else if (function == of_direction_cell) {
        uint steps = direction_steps(number_at(a, 3), number_at(a, 4));
        put_word(r, 0, direction_cell(vec3_at(a, 0), steps, word_at(a, 5)));
        r.y[2] = real(steps);
    } else if (function == of_pack_photon_normal) {
        uint packed = pack_photon_normal(vec3_at(a, 0), small_at(a, 3) != 0u);
        r.y[0] = real(packed & 0x7fffu);
        r.y[1] = real((packed >> 15u) & 0x7fffu);
        r.y[2] = real(packed >> 30u);
    } else if (function == of_unpack_photon_normal) {
        put3(r, 0, unpack_photon_normal(word_at(a, 0)));
    } else if (function == of_kernel_weight) {
        r.y[0] = kernel_weight(number_at(a, 0));
    } else if (function == of_flux_units) {
        r.y[0] = real(flux_units(number_at(a, 0), number_at(a, 1)));
    } else {
        return false;
    }
    return true;
}

FN Values evaluate_maths(uint function, IN(Arguments) a) {
    Values r = no_values();
    if (!evaluate_vectors(function, a, r)) {
        evaluate_samplers(function, a, r);
    }
    return r;
}

ARGAND_SHARED_END

#endif
