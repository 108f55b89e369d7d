// Functions on bits (Morton codes, packed photons, slots, parts, choice of random numbers), and
// compensated sums.
#ifndef ARGAND_TEST_CODES_FUNCTIONS_H
#define ARGAND_TEST_CODES_FUNCTIONS_H

#include "arguments.h"
#include "shared/compensated.h"
#include "shared/morton.h"
#include "shared/parallel_records.h"
#include "shared/photon.h"
#include "shared/query_cell.h"
#include "shared/sampling.h"

ARGAND_SHARED_BEGIN

CONSTANT uint of_add_compensated = 100u;
CONSTANT uint of_spread_bits = 101u;
CONSTANT uint of_leading_zeros = 102u;
CONSTANT uint of_code_distance = 103u;
CONSTANT uint of_morton30 = 104u;
CONSTANT uint of_morton63 = 105u;
CONSTANT uint of_pack_photon_direction = 106u;
CONSTANT uint of_photon_direction_read = 107u;
CONSTANT uint of_photon_is_caustic = 108u;
CONSTANT uint of_eye_random4 = 109u;
CONSTANT uint of_photon_random4 = 110u;
CONSTANT uint of_shuffled_slot = 111u;
CONSTANT uint of_part_size = 112u;

// One coordinate of a Morton code: every third bit.
FN uint coordinate_of_code(uvec2 code, uint first) {
    uint v = 0u;
    for (uint k = 0u; k < 21u; ++k) {
        uint bit = first + 3u * k;
        v |= (((bit < 32u ? code.x : code.y) >> (bit & 31u)) & 1u) << k;
    }
    return v;
}

#ifdef ARGAND_REAL_DOUBLE
// Reference results, computed bit by bit.
FN uint spread_bit_by_bit(uint v) {
    uint spread = 0u;
    for (uint k = 0u; k < 10u; ++k) {
        spread |= ((v >> k) & 1u) << (3u * k);
    }
    return spread;
}

FN uint bits_of_number(uint v) {
    uint bits = 0u;
    for (; v != 0u; v >>= 1u) {
        ++bits;
    }
    return bits;
}

FN uint bit_of_leaf(uvec2 code, uint place, uint bit) {
    uint word = bit >= 64u ? code.y : bit >= 32u ? code.x : place;
    return (word >> (bit & 31u)) & 1u;
}

FN uint highest_difference(uvec2 code_a, uint place_a, uvec2 code_b, uint place_b) {
    uint bit = 95u;
    while (bit > 0u && bit_of_leaf(code_a, place_a, bit) == bit_of_leaf(code_b, place_b, bit)) {
        --bit;
    }
    return bit;
}

FN uint cell_of_code(real x, real low, real high, bool fine) {
    return morton_cell(x, low, high, fine ? real(2097152.0) : real(1024.0));
}

// The least odd number of grains with which `parts` parts hold all elements.
FN uint elements_per_part(real count, real parts, real grain) {
    real grains = ceil(count / (parts * grain));
    bool even = floor(grains * real(0.5)) * real(2.0) == grains;
    return uint((even ? grains + real(1.0) : grains) * grain);
}
#endif

FN Values evaluate_codes(uint function, IN(Arguments) a) {
    Values r = no_values();
    if (function == of_add_compensated) {
        // A sum of 1,024 terms; without compensation it is off by hundreds of ULP.
        real sum = real(0.0);
        real lost = real(0.0);
        vec3 sums = vec3(real(0.0));
        vec3 losts = vec3(real(0.0));
        for (int i = 0; i < 1024; ++i) {
            int k = i % 8;
            add_compensated(sum, lost, number_at(a, k));
            add_compensated(sums, losts, vec3_at(a, 8 + 3 * k));
        }
        r.y[0] = sum;
        put3(r, 1, sums);
    } else if (function == of_spread_bits) {
        put_word(r, 0, must_be(spread_bits(word_at(a, 0)), spread_bit_by_bit(word_at(a, 0))));
    } else if (function == of_leading_zeros) {
        r.y[0] = real(must_be(leading_zeros(word_at(a, 0)), 32u - bits_of_number(word_at(a, 0))));
    } else if (function == of_code_distance) {
        uvec2 code_a = uvec2(word_at(a, 0), word_at(a, 2));
        uvec2 code_b = uvec2(word_at(a, 4), word_at(a, 6));
        uint place_a = word_at(a, 8);
        uint place_b = word_at(a, 10);
        r.y[0] = real(must_be(code_distance(code_a, place_a, code_b, place_b),
                              highest_difference(code_a, place_a, code_b, place_b)));
    } else if (function == of_morton30 || function == of_morton63) {
        vec3 p = vec3_at(a, 0);
        vec3 low = vec3_at(a, 3);
        vec3 high = vec3_at(a, 6);
        bool fine = function == of_morton63;
        uvec2 code = fine ? morton63(p, low, high) : uvec2(morton30(p, low, high), 0u);
        r.y[0] =
            real(must_be(coordinate_of_code(code, 2u), cell_of_code(p.x, low.x, high.x, fine)));
        r.y[1] =
            real(must_be(coordinate_of_code(code, 1u), cell_of_code(p.y, low.y, high.y, fine)));
        r.y[2] =
            real(must_be(coordinate_of_code(code, 0u), cell_of_code(p.z, low.z, high.z, fine)));
        r.y[3] = real(must_be(fine ? code.y >> 31u : code.x >> 30u, 0u));
    } else if (function == of_pack_photon_direction) {
        uint n = small_at(a, 3);
        uint aimed = small_at(a, 4);
        uint packed = pack_photon_direction(vec3_at(a, 0), n, aimed);
        r.y[0] = real((packed & 0xffffu) >> 5u);
        r.y[1] = real(packed >> 21u);
        r.y[2] = real(must_be(photon_scatterings(packed), n > 63u ? 63u : n));
        r.y[3] = must_be(photon_rarity(packed), real(1.0) / real(1u << (aimed & 30u)));
    } else if (function == of_photon_direction_read) {
        put3(r, 0,
             must_be(
                 unpack_unit(pack_photon_direction(vec3_at(a, 0), small_at(a, 3), small_at(a, 4))),
                 vec3_at(a, 0)));
    } else if (function == of_photon_is_caustic) {
        uint packed = pack_photon_normal(vec3_at(a, 0), small_at(a, 3) != 0u);
        packed |= small_at(a, 4) != 0u ? area_sample_bit : 0u;
        r.y[0] = must_be(photon_is_caustic(packed) ? real(1.0) : real(0.0), number_at(a, 3));
    } else if (function == of_eye_random4) {
        vec4 u = eye_random4(word_at(a, 0), word_at(a, 2), word_at(a, 4), small_at(a, 6),
                             small_at(a, 7) != 0u);
        put3(r, 0, vec3(u.x, u.y, u.z));
        r.y[3] = u.w;
    } else if (function == of_photon_random4) {
        vec4 u = photon_random4(word_at(a, 0), word_at(a, 2), small_at(a, 4), small_at(a, 5));
        put3(r, 0, vec3(u.x, u.y, u.z));
        r.y[3] = u.w;
    } else if (function == of_shuffled_slot) {
        uint slot = word_at(a, 0);
        uint shuffled = shuffled_slot(slot);
        put_word(r, 0, shuffled);
        put_word(r, 2, must_be(slot_of_shuffled(shuffled), slot));
    } else if (function == of_part_size) {
        PartsRecord parts;
        parts.parts = small_at(a, 2);
        parts.grain = small_at(a, 3);
        put_word(r, 0,
                 must_be(part_size(word_at(a, 0), parts),
                         elements_per_part(real(word_at(a, 0)), number_at(a, 2), number_at(a, 3))));
    }
    return r;
}

ARGAND_SHARED_END

#endif
