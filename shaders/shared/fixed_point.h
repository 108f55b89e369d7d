// Sums that do not depend on the order of their terms: 64-bit fixed point in two words, the low one in x.
#ifndef ARGAND_SHARED_FIXED_POINT_H
#define ARGAND_SHARED_FIXED_POINT_H

#include "shared/maths.h"

ARGAND_SHARED_BEGIN

// Modulo 2^64; so is the sum of two's complements.
FN uvec2 fixed_add(uvec2 a, uvec2 b) {
    uint low = a.x + b.x;
    uint carry = low < a.x ? 1u : 0u;
    return uvec2(low, a.y + b.y + carry);
}

// The two's complement.
FN uvec2 fixed_negate(uvec2 a) { return fixed_add(uvec2(~a.x, ~a.y), uvec2(1u, 0u)); }

// x in units of 2^-fraction_bits (-126 to 126), rounded down. Less than a unit, negative or NaN: 0; from 2^64 units on:
// the largest number.
FN uvec2 fixed_from_float(float32 x, int fraction_bits) {
    uint bits = float_bits(x);
    if ((bits >> 31u) != 0u || bits > 0x7f800000u) {
        return uvec2(0u, 0u);
    }
    if (bits == 0x7f800000u) {
        return uvec2(0xffffffffu, 0xffffffffu);
    }
    uint mantissa = bits & 0x007fffffu;
    int exponent = int(bits >> 23u);
    if (exponent > 0) {
        mantissa = mantissa | 0x00800000u;
    } else {
        exponent = 1;
    }
    int shift = exponent - 150 + fraction_bits;     // the mantissa counts units of 2^(exponent - 150)
    if (shift <= -24) {
        return uvec2(0u, 0u);
    }
    if (shift <= 0) {
        return uvec2(mantissa >> uint(-shift), 0u);
    }
    if (shift > 40) {   // 24 bits and a shift by 40 fill 64; subnormal numbers never get here
        return uvec2(0xffffffffu, 0xffffffffu);
    }
    if (shift >= 32) {
        return uvec2(0u, mantissa << uint(shift - 32));
    }
    return uvec2(mantissa << uint(shift), mantissa >> uint(32 - shift));
}

// 2^k for k in -126..127.
FN real power_of_two(int k) { return real(bits_float(uint(k + 127) << 23u)); }

FN real fixed_to_real(uvec2 a, int fraction_bits) {
    return (real(a.y) * real(4294967296.0) + real(a.x)) * power_of_two(-fraction_bits);
}

// Of a two's complement.
FN real fixed_to_real_signed(uvec2 a, int fraction_bits) {
    return (a.y >> 31u) != 0u ? -fixed_to_real(fixed_negate(a), fraction_bits) : fixed_to_real(a, fraction_bits);
}

ARGAND_SHARED_END

#endif
