// Area of a triangle in about twice single precision, as the sum of two numbers: exact enough for
// needles, of any size. See pose.h for the arithmetic.
#ifndef ARGAND_SHARED_TRIANGLE_AREA_H
#define ARGAND_SHARED_TRIANGLE_AREA_H

#include "shared/pose.h"

ARGAND_SHARED_BEGIN

// The largest power of two that is not above x > 0; 2^-126 for subnormal x.
FN int exponent_of(float32 x) { return int(max(float_bits(x) >> 23u, 1u)) - 127; }

// to - from, times the power of two that makes its largest coordinate 1 to 2; the exponent of that
// coordinate.
FN PrecisePoint scaled_edge(vec3 from, vec3 to, OUT(int) exponent) {
    PrecisePoint edge = precise_point(to);
    add_without_loss(edge.high.x, edge.low.x, -from.x);
    add_without_loss(edge.high.y, edge.low.y, -from.y);
    add_without_loss(edge.high.z, edge.low.z, -from.z);
    exponent = exponent_of(max_component(abs(edge.high)));
    edge.high = vec3(scale_by_power(edge.high.x, -exponent), scale_by_power(edge.high.y, -exponent),
                     scale_by_power(edge.high.z, -exponent));
    edge.low = vec3(scale_by_power(edge.low.x, -exponent), scale_by_power(edge.low.y, -exponent),
                    scale_by_power(edge.low.z, -exponent));
    return edge;
}

// Adds the square of a d - b c to the sum high + low.
FN void add_square_of_determinant(INOUT(float32) high, INOUT(float32) low, vec2 a, vec2 b, vec2 c,
                                  vec2 d) {
    float32 x = real(0.0);
    float32 rest = real(0.0);
    add_product(x, rest, a.x, d.x);
    add_product(x, rest, -b.x, c.x);
    rest += (a.x * d.y + a.y * d.x) - (b.x * c.y + b.y * c.x);
    float32 sum = x + rest;
    rest -= sum - x;
    add_product(high, low, sum, sum);
    low += real(2.0) * sum * rest;
}

// The area in x, and in y what rounding takes from x. At most single precision's largest number.
FN vec2 precise_triangle_area(vec3 a, vec3 b, vec3 c) {
    int exponent_b = 0;
    int exponent_c = 0;
    PrecisePoint u = scaled_edge(a, b, exponent_b);
    PrecisePoint v = scaled_edge(a, c, exponent_c);
    float32 square = real(0.0);
    float32 rest = real(0.0);
    add_square_of_determinant(square, rest, vec2(u.high.y, u.low.y), vec2(u.high.z, u.low.z),
                              vec2(v.high.y, v.low.y), vec2(v.high.z, v.low.z));
    add_square_of_determinant(square, rest, vec2(u.high.z, u.low.z), vec2(u.high.x, u.low.x),
                              vec2(v.high.z, v.low.z), vec2(v.high.x, v.low.x));
    add_square_of_determinant(square, rest, vec2(u.high.x, u.low.x), vec2(u.high.y, u.low.y),
                              vec2(v.high.x, v.low.x), vec2(v.high.y, v.low.y));
    float32 root = sqrt(max(square + rest, real(0.0)));
    if (!(root > real(0.0))) {
        return vec2(real(0.0), real(0.0));
    }
    float32 product = root * root;
    float32 error = ((square - product) - product_error(root, root, product)) + rest;
    float32 low = error / (real(2.0) * root); // one step of Newton's method
    int exponent = exponent_b + exponent_c - 1;
    float32 area = exponent < -252 ? real(0.0) : scale_by_power(root, exponent);
    if (!is_finite(area)) {
        return vec2(real(3.4028234663852886e38), real(0.0));
    }
    return vec2(area, exponent < -252 ? real(0.0) : scale_by_power(low, exponent));
}

ARGAND_SHARED_END

#endif
