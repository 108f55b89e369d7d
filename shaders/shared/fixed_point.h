// Sums that do not depend on the order of their terms: 64-bit fixed point in two words, the low
// word in x.
#ifndef ARGAND_SHARED_FIXED_POINT_H
#define ARGAND_SHARED_FIXED_POINT_H

#include "shared/maths.h"

ARGAND_SHARED_BEGIN

// Addition modulo 2^64, for two's complements too.
FN uvec2 fixed_add(uvec2 a, uvec2 b) {
    uint low = a.x + b.x;
    uint carry = low < a.x ? 1u : 0u;
    return uvec2(low, a.y + b.y + carry);
}

// Subtraction modulo 2^64.
FN uvec2 fixed_subtract(uvec2 a, uvec2 b) {
    uint borrow = a.x < b.x ? 1u : 0u;
    return uvec2(a.x - b.x, a.y - b.y - borrow);
}

// Whether a < b, without signs.
FN bool fixed_less(uvec2 a, uvec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

// a 2^32 / b, rounded down, at most 2^32 - 1; without signs, b < 2^63.
FN uint fixed_ratio(uvec2 a, uvec2 b) {
    if (!fixed_less(a, b)) {
        return 0xffffffffu;
    }
    uint quotient = 0u;
    for (uint digit = 0u; digit < 32u; ++digit) {
        a = fixed_add(a, a);
        quotient = quotient << 1u;
        if (!fixed_less(a, b)) {
            a = fixed_subtract(a, b);
            quotient = quotient | 1u;
        }
    }
    return quotient;
}

// x 2^scale for a finite x >= 0, rounded down. The result is below 2^64.
FN uvec2 fixed_from_float(float32 x, int scale) {
    uint bits = float_bits(x);
    uint exponent = bits >> 23u;
    uint digits = bits & 0x7fffffu;
    digits = exponent > 0u ? digits | 0x800000u : digits;
    int shift = int(max(exponent, 1u)) - 150 + scale;
    if (shift <= 0) {
        return uvec2(shift > -24 ? digits >> uint(-shift) : 0u, 0u);
    }
    return shift < 32 ? uvec2(digits << uint(shift), digits >> uint(32 - shift))
                      : uvec2(0u, digits << uint(shift - 32));
}

ARGAND_SHARED_END

#endif
