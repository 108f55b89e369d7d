// Sums with compensation for rounding errors, so that a million small terms add up (Kahan 1965,
// "Further remarks on reducing truncation errors").
#ifndef ARGAND_SHARED_COMPENSATED_H
#define ARGAND_SHARED_COMPENSATED_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// lost: the accumulated rounding error of the sum; starts at 0.
FN void add_compensated(INOUT(real) sum, INOUT(real) lost, real term) {
    real y = term - lost;
    real t = sum + y;
    lost = (t - sum) - y;
    sum = t;
}

FN void add_compensated(INOUT(vec3) sum, INOUT(vec3) lost, vec3 term) {
    add_compensated(sum.x, lost.x, term.x);
    add_compensated(sum.y, lost.y, term.y);
    add_compensated(sum.z, lost.z, term.z);
}

ARGAND_SHARED_END

#endif
