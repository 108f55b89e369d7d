// Morton codes number the cells of a box by the interleaved bits of their coordinates, x highest.
#ifndef ARGAND_SHARED_MORTON_H
#define ARGAND_SHARED_MORTON_H

#include "shared/maths.h"

ARGAND_SHARED_BEGIN

// Spreads the lowest ten bits to every third bit.
FN uint spread_bits(uint v) {
    v = v & 0x3ffu;
    v = (v | (v << 16u)) & 0x030000ffu;
    v = (v | (v << 8u)) & 0x0300f00fu;
    v = (v | (v << 4u)) & 0x030c30c3u;
    return (v | (v << 2u)) & 0x09249249u;
}

// Index of the cell of x, of `cells` cells between low and high. Clamps outside; 0 if the extent is
// 0 or x is NaN.
FN uint morton_cell(real x, real low, real high, real cells) {
    real extent = high - low;
    // Scaled down, so that a box as large as single precision's range has a finite extent.
    if (!is_finite(extent)) {
        x *= real(0.25);
        low *= real(0.25);
        extent = high * real(0.25) - low;
    }
    if (!(x > low) || !(extent > real(0.0))) {
        return 0u;
    }
    // The quotient exceeds 1 by more than rounding only if x lies outside.
    return uint(min(min((x - low) / extent, real(1.0)) * cells, cells - real(1.0)));
}

// 30-bit code, ten bits for each axis.
FN uint morton30(vec3 p, vec3 low, vec3 high) {
    uint x = morton_cell(p.x, low.x, high.x, real(1024.0));
    uint y = morton_cell(p.y, low.y, high.y, real(1024.0));
    uint z = morton_cell(p.z, low.z, high.z, real(1024.0));
    return (spread_bits(x) << 2u) | (spread_bits(y) << 1u) | spread_bits(z);
}

// 63-bit code, 21 bits for each axis; low word and high word.
FN uvec2 morton63(vec3 p, vec3 low, vec3 high) {
    uint x = morton_cell(p.x, low.x, high.x, real(2097152.0));
    uint y = morton_cell(p.y, low.y, high.y, real(2097152.0));
    uint z = morton_cell(p.z, low.z, high.z, real(2097152.0));
    uint lowest = (spread_bits(x) << 2u) | (spread_bits(y) << 1u) | spread_bits(z);
    uint middle =
        (spread_bits(x >> 10u) << 2u) | (spread_bits(y >> 10u) << 1u) | spread_bits(z >> 10u);
    uint highest = ((x >> 20u) << 2u) | ((y >> 20u) << 1u) | (z >> 20u);
    return uvec2(lowest | (middle << 30u), (middle >> 2u) | (highest << 28u));
}

// Zero bits above the highest one; 32 for 0.
FN uint leading_zeros(uint v) { return uint(31 - findMSB(v)); }

// Distance of two leaves whose codes are neighbours in their order: the index of the highest bit in
// which the codes differ, each followed by its leaf's index so that equal codes differ too (Karras
// 2012, "Maximizing Parallelism in the Construction of BVHs, Octrees, and k-d Trees"). 30-bit codes
// are the high word.
FN uint code_distance(uvec2 code_a, uint place_a, uvec2 code_b, uint place_b) {
    return code_a.y != code_b.y   ? 95u - leading_zeros(code_a.y ^ code_b.y)
           : code_a.x != code_b.x ? 63u - leading_zeros(code_a.x ^ code_b.x)
                                  : 31u - leading_zeros(place_a ^ place_b);
}

// Distance beyond the first or last leaf.
CONSTANT uint no_neighbour = 96u;

ARGAND_SHARED_END

#endif
