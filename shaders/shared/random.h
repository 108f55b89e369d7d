// Counter-based random numbers: a hash of seed and counters, so that they depend neither on
// scheduling nor on the backend.
#ifndef ARGAND_SHARED_RANDOM_H
#define ARGAND_SHARED_RANDOM_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering": one linear congruential step per
// lane, then two rounds of mixing across lanes. A bijection, so different counters never give the
// same four words.
FN uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v = v ^ (v >> 16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// Uniform in [0, 1), a multiple of 2^-24. Single precision holds the highest 24 bits exactly and
// never rounds them to 1.
FN real to_unit(uint bits) { return real(bits >> 8u) * real(5.9604644775390625e-8); }

// Four independent numbers in [0, 1) for (seed, index, bounce, dimension).
FN vec4 random4(uint seed, uint index, uint bounce, uint dimension) {
    uvec4 counter = uvec4(index, bounce, dimension, seed);
    // The hash never carries high bits of a counter to lower ones, so fold them down first.
    uvec4 bits = pcg4d(counter ^ (counter >> 16u));
    return vec4(to_unit(bits.x), to_unit(bits.y), to_unit(bits.z), to_unit(bits.w));
}

ARGAND_SHARED_END

#endif
