// How much light a shadow ray brings through surfaces that are partly absent.
#ifndef ARGAND_SHARED_ALPHA_H
#define ARGAND_SHARED_ALPHA_H

#include "shared/elementary.h"

ARGAND_SHARED_BEGIN

// Thickness of a surface: -ln(1 - coverage), in units of 2^-24. Sums are the same in any order, so
// that rays find the same light in any tree.
CONSTANT uint thickness_of_all = 0xffffffffu; // no light passes
// Of this thickness on, less passes than half the smallest positive number: exp(-104).
CONSTANT uint most_thickness = 1744830464u;

// coverage: in [0,1]. The light that passes is off by a relative error of 3e-8, or 2^-24 for
// coverages of which 1 - coverage has few digits left.
FN uint thickness_of(real coverage) {
    if (!(coverage < real(1.0))) {
        return thickness_of_all;
    }
    return uint(-log_complement(max(coverage, real(0.0))) * real(16777216.0) + real(0.5));
}

FN uint add_thickness(uint sum, uint more) {
    if (sum >= most_thickness || more >= most_thickness || sum + more >= most_thickness) {
        return thickness_of_all;
    }
    return sum + more;
}

// Share of the light that passes surfaces of this thickness.
FN real transmittance(uint thickness) {
    if (thickness >= most_thickness) {
        return real(0.0);
    }
    return exp_negative(-real(thickness) * real(5.9604644775390625e-8));
}

ARGAND_SHARED_END

#endif
