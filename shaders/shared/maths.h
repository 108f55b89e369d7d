#ifndef ARGAND_SHARED_MATHS_H
#define ARGAND_SHARED_MATHS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

CONSTANT real PI = real(3.14159265358979323846);
CONSTANT real INV_PI = real(0.31830988618379067154);

FN real sqr(real x) { return x * x; }

// On the bits, for compilers may assume that isnan is false.
FN bool is_finite(real x) { return (float_bits(float32(x)) & 0x7f800000u) != 0x7f800000u; }

FN real max_component(vec3 v) { return max(v.x, max(v.y, v.z)); }

FN real mean_component(vec3 v) { return (v.x + v.y + v.z) * real(0.33333333333333333333); }

// Rounding may have made a difference of squares slightly negative.
FN real safe_sqrt(real x) { return sqrt(max(x, real(0.0))); }

// Sine and cosine of 2 pi u, for u in [0, 1]: the built-ins differ between drivers. The argument is reduced exactly to
// an eighth of the circle; there the Taylor series' first left-out term is below 2^-26.
FN void sincos_2pi(real u, OUT(real) s, OUT(real) c) {
    real quarter = floor(u * real(4.0) + real(0.5));
    real x = (u - quarter * real(0.25)) * (real(2.0) * PI);
    real x2 = x * x;
    real sine = x * (real(1.0) + x2 * (real(-1.0) / real(6.0) + x2 * (real(1.0) / real(120.0) +
                x2 * (real(-1.0) / real(5040.0) + x2 * (real(1.0) / real(362880.0) - x2 / real(39916800.0))))));
    real cosine = real(1.0) + x2 * (real(-0.5) + x2 * (real(1.0) / real(24.0) + x2 * (real(-1.0) / real(720.0) +
                  x2 * (real(1.0) / real(40320.0) + x2 * (real(-1.0) / real(3628800.0) + x2 / real(479001600.0))))));
    uint q = uint(quarter) & 3u;
    s = (q & 1u) != 0u ? cosine : sine;
    c = (q & 1u) != 0u ? sine : cosine;
    s = (q & 2u) != 0u ? -s : s;
    c = (q == 1u || q == 2u) ? -c : c;
}

ARGAND_SHARED_END

#endif
