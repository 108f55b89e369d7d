#ifndef ARGAND_SHARED_LATTICE_H
#define ARGAND_SHARED_LATTICE_H

#include "shared/random.h"

ARGAND_SHARED_BEGIN

// Points of any number of dimensions without a table: Korobov's rank-1 lattice of 2^32 points, in
// the order of their multiples. Coordinate d of point i is the fraction of i a^(d + 1) / 2^32. Any
// number of points that follow one another are well distributed, as those of a Kronecker sequence.
// (In van der Corput's order, the usual one, 16 points have but eight different coordinates: most
// vertices of a path would share them.)

// Of 400,000 numbers the one by which 16, 64, 256 and 1,024 points have the least error in the
// dimensions of the first vertices: over random shifts, of functions whose Fourier coefficients
// fall with the square of the frequency, by four, eight and twelve dimensions.
CONSTANT uint korobov_factor = 333725237u;

FN uint power_of(uint base, uint exponent) {
    uint power = 1u;
    for (; exponent != 0u; exponent >>= 1) {
        power *= (exponent & 1u) != 0u ? base : 1u;
        base *= base;
    }
    return power;
}

// Dimensions 4 set ... 4 set + 3 of the point with this index, as 32-bit fractions.
FN uvec4 lattice4(uint index, uint set) {
    uint first = index * power_of(korobov_factor, 4u * set + 1u);
    uint second = first * korobov_factor;
    uint third = second * korobov_factor;
    return uvec4(first, second, third, third * korobov_factor);
}

// The same, in [0, 1), moved by a vector that hangs on (seed, stream, set) (Cranley and Patterson
// 1976).
FN vec4 lattice_random4(uint seed, uint stream, uint index, uint set) {
    uvec4 p = lattice4(index, set) + pcg4d(uvec4(stream, set, seed, 0x1a771ceu));
    return vec4(to_unit(p.x), to_unit(p.y), to_unit(p.z), to_unit(p.w));
}

ARGAND_SHARED_END

#endif
