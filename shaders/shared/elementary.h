// Elementary functions, exact to a few units in the last place (ULP) on every device: built-ins differ between drivers
// (acos by 3,500 ULP on lavapipe). Minimax polynomials after reduction of the argument; without fused multiply-add,
// with which the tricks below that split numbers would still be right but the bits would differ. As double they are the
// standard library's, the tests' truth.
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
    s = x + x * (z * (real(-0.16666654873513564) + z * (real(0.008332173545502582) + z * real(-0.0001951665613228911))));
    c = real(1.0) - (real(0.5) * z - z * z * (real(0.041666646747906703) +
        z * (real(-0.0013887361455679613) + z * real(2.443773065703703e-05))));
}

// asin(x) - x over x, as a function of z = x² up to 1/4.
FN real asin_remainder(real z) {
    return z * (real(0.16666753925067881) + z * (real(0.07495241836698374) + z * (real(0.04547709315910427) +
           z * (real(0.02414762262481871) + z * real(0.04221853663915809)))));
}

// atan(x) - x over x, as a function of z = x² up to tan²(pi/8).
FN real atan_remainder(real z) {
    return z * (real(-0.33333315423859367) + z * (real(0.1999848401751824) + z * (real(-0.1424373907927387) +
           z * (real(0.10595141781612295) + z * real(-0.06081160509287167)))));
}

// exp(x) - 1 - x for |x| up to ln(2)/2.
FN real exp_remainder(real x) {
    return x * x * (real(0.5000000101259033) + x * (real(0.1666651289384798) + x * (real(0.04166618637093602) +
           x * (real(0.008369598011938885) + x * real(0.0013951773318023543)))));
}

// atanh(s)/s - 1 - s²/3 over s⁴, as a function of z = s², for exp(2 atanh(s)) between sqrt(1/2) and sqrt(2).
FN real atanh_tail(real z) {
    return real(0.2000007844039877) + z * (real(0.14273316197216385) + z * real(0.117155045457851));
}

CONSTANT real LN2_HIGH = real(0.693145751953125);           // 15 bits, so that multiples up to 2^9 are exact
CONSTANT real LN2_LOW = real(1.428606765330187e-06);
CONSTANT real LOG2_E = real(1.44269504088896341);

// x times 2^k for k in -252..254, by way of two factors that are both normal numbers.
FN real scale_by_power(real x, int k) {
    int half_k = k >> 1;
    return x * bits_float(uint(half_k + 127) << 23u) * bits_float(uint(k - half_k + 127) << 23u);
}

// Splits a normal or subnormal x > 0 in m 2^k, m between sqrt(1/2) and sqrt(2).
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

// The highest 12 bits of x: products of two such numbers are exact.
FN real high_half(real x) { return bits_float(float_bits(x) & 0xfffff000u); }

// What rounding took from p = a b (Dekker 1971).
FN real product_error(real a, real b, real p) {
    real ah = high_half(a);
    real bh = high_half(b);
    real al = a - ah;
    real bl = b - bh;
    return ((ah * bh - p) + ah * bl + al * bh) + al * bl;
}

// high + low += x (Knuth's two-sum).
FN void add_without_loss(INOUT(real) high, INOUT(real) low, real x) {
    real sum = high + x;
    real part = sum - high;
    low += (high - (sum - part)) + (x - part);
    high = sum;
}

#endif

// On the bits, for compilers may assume that a number is never NaN.
FN bool is_finite(real x) {
#ifdef ARGAND_REAL_DOUBLE
    return std::isfinite(x);
#else
    return (float_bits(x) & 0x7f800000u) != 0x7f800000u;
#endif
}

// Sine and cosine of 2 pi u, the angle of u full turns, |u| < 2^20. The reduction to an eighth of a turn is exact.
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

// Sine and cosine for |x| up to 8192 [rad]. Cody and Waite 1980: pi/2 in four parts, of which the first three have so
// few bits that their multiples are exact.
FN void sincos_real(real x, OUT(real) s, OUT(real) c) {
#ifdef ARGAND_REAL_DOUBLE
    s = std::sin(x);
    c = std::cos(x);
#else
    real quarter = floor(x * real(0.63661977236758134) + real(0.5));
    real r = ((x - quarter * real(1.5703125)) - quarter * real(0.0004837512969970703)) -
             quarter * real(7.549533620476723e-08);
    r = r - quarter * real(2.5633440682570896e-12);
    real sine, cosine;
    sincos_eighth(r, sine, cosine);
    uint q = uint(int(quarter)) & 3u;
    s = (q & 1u) != 0u ? cosine : sine;
    c = (q & 1u) != 0u ? sine : cosine;
    s = (q & 2u) != 0u ? -s : s;
    c = (q == 1u || q == 2u) ? -c : c;
#endif
}

// Arc cosine [0, pi]; x beyond ±1 counts as ±1.
FN real acos_real(real x) {
    real a = min(abs(x), real(1.0));
#ifdef ARGAND_REAL_DOUBLE
    return std::acos(x < 0 ? -a : a);
#else
    if (a <= real(0.5)) {
        real s = x + x * asin_remainder(x * x);
        return real(1.57079637050628662) - (s + real(4.37113882867379e-8));   // pi/2 in two parts
    }
    real z = (real(1.0) - a) * real(0.5);   // exact
    real s = sqrt(z);                       // the sine of half the angle
    real r = real(2.0) * (s + s * asin_remainder(z));
    return x < real(0.0) ? real(3.14159274101257324) - (r + real(8.74227765734758e-8)) : r;
#endif
}

// Angle of (x, y) from the x axis, [-pi, pi]; 0 or ±pi for x = y = 0. Finite arguments.
FN real atan2_real(real y, real x) {
#ifdef ARGAND_REAL_DOUBLE
    return std::atan2(y, x);
#else
    real ax = abs(x);
    real ay = abs(y);
    real large = max(ax, ay);
    real small = min(ax, ay);
    real a = real(0.0);
    if (large > real(0.0)) {
        if (large > real(1e38)) {   // so that the sum below stays finite
            large *= real(0.25);
            small *= real(0.25);
        }
        bool eighth = small > real(0.41421356) * large;
        real t = eighth ? (small - large) / (small + large) : small / large;
        a = t + t * atan_remainder(t * t);
        a = eighth ? real(0.785398185253143311) + (a - real(2.1855694143368964e-8)) : a;   // pi/4 in two parts
    }
    a = ay > ax ? real(1.57079637050628662) - (a + real(4.37113882867379e-8)) : a;
    // The sign bit, not the sign, tells the side of zeros.
    a = (float_bits(x) >> 31u) != 0u ? real(3.14159274101257324) - (a + real(8.74227765734758e-8)) : a;
    return (float_bits(y) >> 31u) != 0u ? -a : a;
#endif
}

FN real exp_real(real x) {
#ifdef ARGAND_REAL_DOUBLE
    return std::exp(x);
#else
    if (!is_finite(x)) {
        return (float_bits(x) == 0xff800000u) ? real(0.0) : x;
    }
    real bounded = clamp(x, real(-104.0), real(89.0));      // below the least number, above the largest
    real k = floor(bounded * LOG2_E + real(0.5));
    real high = bounded - k * LN2_HIGH;
    real low = k * LN2_LOW;
    real r = high - low;
    return scale_by_power(real(1.0) + ((exp_remainder(r) - low) + high), int(k));
#endif
}

// Natural logarithm; -infinity for 0, NaN below.
FN real log_real(real x) {
#ifdef ARGAND_REAL_DOUBLE
    return std::log(x);
#else
    if (!is_finite(x) || x <= real(0.0)) {
        uint bits = float_bits(x);
        bool zero = (bits & 0x7fffffffu) == 0u;
        return zero ? bits_float(0xff800000u) : bits_float(bits == 0x7f800000u ? bits : 0x7fc00000u);
    }
    int exponent;
    real f = split_mantissa(x, exponent) - real(1.0);       // exact
    real k = real(exponent);
    real s = f / (real(2.0) + f);
    real half_square = real(0.5) * f * f;
    // log(1+f) = 2 atanh(s) = f - (f²/2 - s (f²/2 + R)), where f itself is exact.
    real z = s * s;
    real remainder = real(2.0) * z * (real(0.33333333333333333) + z * atanh_tail(z));
    return k * LN2_HIGH - ((half_square - (s * (half_square + remainder) + k * LN2_LOW)) - f);
#endif
}

// x to the power of y, for finite x >= 0 and y. The logarithm is carried in two numbers, for a result near the largest
// number multiplies its relative error by 88.
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
    // s³/3 and what rounding took from it
    real z = s * s;
    real cube = s * z;
    real cube_low = product_error(s, z, cube) + s * product_error(s, s, z);
    real third = cube / real(3.0);
    p = real(3.0) * third;
    real third_low = (((cube - p) - product_error(real(3.0), third, p)) + cube_low) / real(3.0);
    // log(x) = k ln(2) + 2 atanh(s), the terms added without loss from the largest down.
    real high = k * LN2_HIGH;
    real low = k * LN2_LOW + real(2.0) * ((s_low + third_low) + (z * s_low + cube * z * atanh_tail(z)));
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
