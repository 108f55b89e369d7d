#ifndef ARGAND_SHARED_SOBOL_H
#define ARGAND_SHARED_SOBOL_H

#include "shared/random.h"

ARGAND_SHARED_BEGIN

// Sobol' points with hash-based Owen scrambling (Burley 2020, "Practical Hash-based Owen
// Scrambling"). Four dimensions are jointly well distributed over consecutive indices; each further
// set of four shuffles the indices in its own way.

// Direction numbers of the third and fourth dimension (Joe and Kuo 2008). Those of the first two
// are computed.
#ifdef __cplusplus
TABLE uvec2 sobol_directions[32] = {
#else
const uvec2 sobol_directions[32] = uvec2[32](
#endif
    uvec2(0x80000000u, 0x80000000u),
    uvec2(0xc0000000u, 0xc0000000u),
    uvec2(0x60000000u, 0x20000000u),
    uvec2(0x90000000u, 0x50000000u),
    uvec2(0xe8000000u, 0xf8000000u),
    uvec2(0x5c000000u, 0x74000000u),
    uvec2(0x8e000000u, 0xa2000000u),
    uvec2(0xc5000000u, 0x93000000u),
    uvec2(0x68800000u, 0xd8800000u),
    uvec2(0x9cc00000u, 0x25400000u),
    uvec2(0xee600000u, 0x59e00000u),
    uvec2(0x55900000u, 0xe6d00000u),
    uvec2(0x80680000u, 0x78080000u),
    uvec2(0xc09c0000u, 0xb40c0000u),
    uvec2(0x60ee0000u, 0x82020000u),
    uvec2(0x90550000u, 0xc3050000u),
    uvec2(0xe8808000u, 0x208f8000u),
    uvec2(0x5cc0c000u, 0x51474000u),
    uvec2(0x8e606000u, 0xfbea2000u),
    uvec2(0xc5909000u, 0x75d93000u),
    uvec2(0x6868e800u, 0xa0858800u),
    uvec2(0x9c9c5c00u, 0x914e5400u),
    uvec2(0xeeee8e00u, 0xdbe79e00u),
    uvec2(0x5555c500u, 0x25db6d00u),
    uvec2(0x8000e880u, 0x58800080u),
    uvec2(0xc0005cc0u, 0xe54000c0u),
    uvec2(0x60008e60u, 0x79e00020u),
    uvec2(0x9000c590u, 0xb6d00050u),
    uvec2(0xe8006868u, 0x800800f8u),
    uvec2(0x5c009c9cu, 0xc00c0074u),
    uvec2(0x8e00eeeeu, 0x200200a2u),
    uvec2(0xc5005555u, 0x50050093u)
#ifdef __cplusplus
};
#else
);
#endif

FN uint reverse_bits(uint v) {
    v = (v << 16) | (v >> 16);
    v = ((v & 0x00ff00ffu) << 8) | ((v & 0xff00ff00u) >> 8);
    v = ((v & 0x0f0f0f0fu) << 4) | ((v & 0xf0f0f0f0u) >> 4);
    v = ((v & 0x33333333u) << 2) | ((v & 0xccccccccu) >> 2);
    return ((v & 0x55555555u) << 1) | ((v & 0xaaaaaaaau) >> 1);
}

// Owen scrambling of a number with reversed bits: a hash of the lower bits flips each bit (Laine
// and Karras 2011, constants by Vegdahl 2021).
FN uint owen_scramble_reversed(uint v, uint seed) {
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16) | 1u;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return v;
}

FN uint owen_scramble(uint v, uint seed) {
    return reverse_bits(owen_scramble_reversed(reverse_bits(v), seed));
}

// The unscrambled point with this index, as 32-bit fractions.
FN uvec4 sobol4(uint index) {
    uvec4 p = uvec4(reverse_bits(index), 0u, 0u, 0u);
    uint second = 0x80000000u;
    for (uint bit = 0u; bit < 32u; ++bit) {
        if (((index >> bit) & 1u) != 0u) {
            p.y ^= second;
            p.z ^= sobol_directions[bit].x;
            p.w ^= sobol_directions[bit].y;
        }
        second ^= second >> 1;
    }
    return p;
}

// Four numbers in [0, 1) for sample `index` of the sequence of (seed, stream, dimension).
FN vec4 sobol_random4(uint seed, uint stream, uint index, uint dimension) {
    uvec4 hash = pcg4d(uvec4(stream, dimension, seed, 0x68bc21ebu));
    uvec4 p = sobol4(owen_scramble(index, hash.x));
    return vec4(to_unit(owen_scramble(p.x, hash.y)), to_unit(owen_scramble(p.y, hash.z)),
                to_unit(owen_scramble(p.z, hash.w)), to_unit(owen_scramble(p.w, hash.x ^ hash.z)));
}

ARGAND_SHARED_END

#endif
