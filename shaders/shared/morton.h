#ifndef ARGAND_SHARED_MORTON_H
#define ARGAND_SHARED_MORTON_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Two zero bits between any two of the lowest ten.
FN uint spread_bits(uint v) {
    v = (v * 0x00010001u) & 0xff0000ffu;
    v = (v * 0x00000101u) & 0x0f00f00fu;
    v = (v * 0x00000011u) & 0xc30c30c3u;
    v = (v * 0x00000005u) & 0x49249249u;
    return v;
}

// Cell of x among 1,024 from low to high; a box without extent has one cell.
FN uint morton_cell(real x, real low, real high) {
    real extent = high - low;
    real scaled = extent > real(0.0) ? (x - low) / extent * real(1024.0) : real(0.0);
    return uint(clamp(scaled, real(0.0), real(1023.0)));
}

// 30-bit Morton code of a point in a box.
FN uint morton30(vec3 p, vec3 low, vec3 high) {
    return spread_bits(morton_cell(p.x, low.x, high.x)) * 4u + spread_bits(morton_cell(p.y, low.y, high.y)) * 2u +
           spread_bits(morton_cell(p.z, low.z, high.z));
}

ARGAND_SHARED_END

#endif
