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

ARGAND_SHARED_END

#endif
