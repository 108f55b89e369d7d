// Elementary functions, accurate to a few units in the last place (ULP) on every device; built-ins
// differ between drivers (pow by 20 ULP on lavapipe). Minimax polynomials after argument reduction.
// No fused multiply-add: the error-free transformations below would survive it, but the bits would
// differ. In double precision these functions are the standard library's, which tests take as the
// truth.
#ifndef ARGAND_SHARED_ELEMENTARY_H
#define ARGAND_SHARED_ELEMENTARY_H

#include "shared/prelude.h"

#ifdef ARGAND_REAL_DOUBLE
#include <cmath>
#endif

ARGAND_SHARED_BEGIN

CONSTANT real PI = real(3.14159265358979323846);
CONSTANT real INV_PI = real(0.31830988618379067154);

#ifndef ARGAND_REAL_DOUBLE

// Sine and cosine for |x| up to pi/4.
FN void sincos_eighth(real x, OUT(real) s, OUT(real) c) {
    real z = x * x;
    s = x + x * (z * (real(-0.16666654873513564) +
                      z * (real(0.008332173545502582) + z * real(-0.0001951665613228911))));
    c = real(1.0) -
        (real(0.5) * z - z * z *
                             (real(0.041666646747906703) + z * (real(-0.0013887361455679613) +
                                                                z * real(2.443773065703703e-05))));
}

// exp(x) - 1 - x for |x| up to ln(2)/2.
FN real exp_remainder(real x) {
    return x * x *
           (real(0.5000000101259033) +
            x * (real(0.1666651289384798) +
                 x * (real(0.04166618637093602) +
                      x * (real(0.008369598011938885) + x * real(0.0013951773318023543)))));
}

// (atanh(s)/s - 1 - s²/3) / s⁴ as a function of z = s²; accurate while exp(2 atanh(s)) is between
// sqrt(1/2) and sqrt(2).
FN real atanh_tail(real z) {
    return real(0.2000007844039877) + z * (real(0.14273316197216385) + z * real(0.117155045457851));
}

CONSTANT real LN2_HIGH = real(0.693145751953125); // 15 bits, so that multiples up to 2^9 are exact
CONSTANT real LN2_LOW = real(1.428606765330187e-06);
CONSTANT real LOG2_E = real(1.44269504088896341);

// x times 2^k for k in -252..254, as two factors that are both normal numbers.
FN real scale_by_power(real x, int k) {
    int half_k = k >> 1;
    return x * bits_float(uint(half_k + 127) << 23u) * bits_float(uint(k - half_k + 127) << 23u);
}

// Splits a normal or subnormal x > 0 into m 2^k, m between sqrt(1/2) and sqrt(2).
FN real split_mantissa(real x, OUT(int) k) {
    k = -127;
    if (x < real(1.1754943508222875e-38)) {
        x *= real(8388608.0);
        k -= 23;
    }
    uint bits = float_bits(x);
    k += int(bits >> 23u);
    real m = bits_float((bits & 0x007fffffu) | 0x3f800000u);
    if (m > real(1.41421356)) {
        m *= real(0.5);
        k += 1;
    }
    return m;
}

// The highest 12 bits of x. Products of two such numbers are exact.
FN real high_half(real x) { return bits_float(float_bits(x) & 0xfffff000u); }

// Rounding error of p = a b (Dekker 1971).
FN real product_error(real a, real b, real p) {
    real ah = high_half(a);
    real bh = high_half(b);
    real al = a - ah;
    real bl = b - bh;
    return ((ah * bh - p) + ah * bl + al * bh) + al * bl;
}

// Adds x to high + low without rounding error (Knuth's two-sum).
FN void add_without_loss(INOUT(real) high, INOUT(real) low, real x) {
    real sum = high + x;
    real part = sum - high;
    low += (high - (sum - part)) + (x - part);
    high = sum;
}

// 2 atanh(s), for |s| up to 0.172.
FN real twice_atanh(real s) {
    real z = s * s;
    return real(2.0) * (s + s * z * (real(0.3333333333333333) + z * atanh_tail(z)));
}

#endif

// Tests the bits, because compilers may assume that a number is never NaN.
FN bool is_finite(real x) {
#ifdef ARGAND_REAL_DOUBLE
    return std::isfinite(x);
#else
    return (float_bits(x) & 0x7f800000u) != 0x7f800000u;
#endif
}

// Sine and cosine of 2 pi u, the angle of u full turns, |u| < 2^20. The reduction to an eighth of a
// turn is exact.
FN void sincos_2pi(real u, OUT(real) s, OUT(real) c) {
    real quarter = floor(u * real(4.0) + real(0.5));
    real x = (u - quarter * real(0.25)) * (real(2.0) * PI);
    real sine, cosine;
#ifdef ARGAND_REAL_DOUBLE
    sine = std::sin(x);
    cosine = std::cos(x);
#else
    sincos_eighth(x, sine, cosine);
#endif
    uint q = uint(int(quarter)) & 3u;
    s = (q & 1u) != 0u ? cosine : sine;
    c = (q & 1u) != 0u ? sine : cosine;
    s = (q & 2u) != 0u ? -s : s;
    c = (q == 1u || q == 2u) ? -c : c;
}

// The angle of (x, y) from the x axis, in turns, from -1/2 to 1/2; 0 for (0, 0). atan2(y, x)/(2
// pi).
FN real turn_of(real y, real x) {
#ifdef ARGAND_REAL_DOUBLE
    return std::atan2(y, x) / (real(2.0) * PI);
#else
    real a = abs(x);
    real b = abs(y);
    real largest = max(a, b);
    if (!(largest > real(0.0))) {
        return real(0.0);
    }
    real s = min(a, b) / largest;
    // Beyond an eighth of pi the angle is that of (1 + s, 1 - s) short of an eighth of a turn.
    bool reduce = s > real(0.41421356);
    real r = reduce ? (s - real(1.0)) / (s + real(1.0)) : s;
    real z = r * r;
    real tail = real(-0.33333331761166274) +
                z * (real(0.19999540483502168) +
                     z * (real(-0.1426395559525927) +
                          z * (real(0.10743731471527072) + z * real(-0.06451928161888948))));
    real turn = (r + r * (z * tail)) * (real(0.5) * INV_PI);
    turn = reduce ? real(0.125) + turn : turn;
    turn = b > a ? real(0.25) - turn : turn;
    turn = x < real(0.0) ? real(0.5) - turn : turn;
    return y < real(0.0) ? -turn : turn;
#endif
}

// log(1 - x) for x in [0, 1), with a small relative error even where 1 - x has lost the digits of
// x.
FN real log_complement(real x) {
#ifdef ARGAND_REAL_DOUBLE
    return std::log1p(-x);
#else
    if (x < real(0.29)) {
        return twice_atanh(-x / (real(2.0) - x));
    }
    int exponent;
    real f = split_mantissa(real(1.0) - x, exponent) - real(1.0);
    real k = real(exponent);
    return k * LN2_HIGH + (k * LN2_LOW + twice_atanh(f / (real(2.0) + f)));
#endif
}

// exp(x) for x <= 0.
FN real exp_negative(real x) {
#ifdef ARGAND_REAL_DOUBLE
    return std::exp(x);
#else
    if (!(x > real(-104.0))) {
        return real(0.0); // less than half the smallest positive number
    }
    real power = floor(x * LOG2_E + real(0.5));
    real r = (x - power * LN2_HIGH) - power * LN2_LOW;
    return scale_by_power(real(1.0) + (r + exp_remainder(r)), int(power));
#endif
}

// 1 - exp(x) for x <= 0, with a small relative error even for small x.
FN real exp_complement(real x) {
#ifdef ARGAND_REAL_DOUBLE
    return -std::expm1(x);
#else
    return x > real(-0.34) ? -(x + exp_remainder(x)) : real(1.0) - exp_negative(x);
#endif
}

// x to the power of y, for finite x >= 0 and y. The logarithm is carried in two numbers because a
// result near the largest number multiplies its relative error by 88.
FN real pow_real(real x, real y) {
#ifdef ARGAND_REAL_DOUBLE
    return std::pow(x, y);
#else
    if (y == real(0.0) || x == real(1.0)) {
        return real(1.0);
    }
    if (!(x > real(0.0))) {
        return bits_float(y > real(0.0) ? 0u : 0x7f800000u);
    }
    int exponent;
    real f = split_mantissa(x, exponent) - real(1.0);
    real k = real(exponent);
    // s + s_low = f / (2 + f)
    real d = real(2.0) + f;
    real d_low = f - (d - real(2.0));
    real s = f / d;
    real p = s * d;
    real s_low = (((f - p) - product_error(s, d, p)) - s * d_low) / d;
    // s³/3 and its rounding error
    real z = s * s;
    real cube = s * z;
    real cube_low = product_error(s, z, cube) + s * product_error(s, s, z);
    real third = cube / real(3.0);
    p = real(3.0) * third;
    real third_low = (((cube - p) - product_error(real(3.0), third, p)) + cube_low) / real(3.0);
    // log(x) = k ln(2) + 2 atanh(s), with the terms added without loss from the largest down
    real high = k * LN2_HIGH;
    real low =
        k * LN2_LOW + real(2.0) * ((s_low + third_low) + (z * s_low + cube * z * atanh_tail(z)));
    add_without_loss(high, low, real(2.0) * s);
    add_without_loss(high, low, real(2.0) * third);
    real log_x = high + low;
    real log_low = low - (log_x - high);
    // y log(x)
    real e = y * log_x;
    if (!(abs(e) < real(150.0))) {
        return bits_float(e > real(0.0) ? 0x7f800000u : 0u);
    }
    real e_low = product_error(y, log_x, e) + y * log_low;
    real power = floor(e * LOG2_E + real(0.5));
    real r = (e - power * LN2_HIGH) - (power * LN2_LOW - e_low);
    real result = real(1.0) + (r + exp_remainder(r));
    return power > real(200.0) ? bits_float(0x7f800000u) : scale_by_power(result, int(power));
#endif
}

ARGAND_SHARED_END

#endif
