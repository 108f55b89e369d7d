// Morphs, skins and transforms vertices. Positions are computed in about twice single precision, as
// sums of two numbers, so that they are rounded once, wherever the object lies in its own space:
// Ogita, Rump and Oishi 2005 ("Accurate sum and dot product", algorithm 5.3).
#ifndef ARGAND_SHARED_POSE_H
#define ARGAND_SHARED_POSE_H

#include "shared/maths.h"
#include "shared/pose_records.h"

ARGAND_SHARED_BEGIN

// Adds a b to the sum high + low.
FN void add_product(INOUT(float32) high, INOUT(float32) low, float32 a, float32 b) {
    float32 product = a * b;
    add_without_loss(high, low, product);
    low += product_error(a, b, product);
}

// A point whose coordinates are sums of two numbers.
struct PrecisePoint {
    vec3 high, low;
};

FN PrecisePoint precise_point(vec3 p) {
    PrecisePoint result;
    result.high = p;
    result.low = vec3(real(0.0));
    return result;
}

FN void add_weighted(INOUT(PrecisePoint) p, MorphWeight weight, vec3 offset) {
    add_product(p.high.x, p.low.x, weight.high, offset.x);
    add_product(p.high.y, p.low.y, weight.high, offset.y);
    add_product(p.high.z, p.low.z, weight.high, offset.z);
    p.low += weight.low * offset;
}

// Adds weight p, for a weight without remainder.
FN void add_weighted(INOUT(PrecisePoint) sum, float32 weight, IN(PrecisePoint) p) {
    add_product(sum.high.x, sum.low.x, weight, p.high.x);
    add_product(sum.high.y, sum.low.y, weight, p.high.y);
    add_product(sum.high.z, sum.low.z, weight, p.high.z);
    sum.low += weight * p.low;
}

// A coordinate of a transformed point, by a row of the matrix.
FN void transform_by_row(IN(lane4) row, IN(lane4) row_low, IN(PrecisePoint) p, OUT(float32) high,
                         OUT(float32) low) {
    high = row.w;
    low = row_low.w;
    add_product(high, low, row.x, p.high.x);
    add_product(high, low, row.y, p.high.y);
    add_product(high, low, row.z, p.high.z);
    low += (row_low.x * p.high.x + row_low.y * p.high.y + row_low.z * p.high.z) +
           (row.x * p.low.x + row.y * p.low.y + row.z * p.low.z);
}

FN PrecisePoint transformed(IN(PoseMatrix) m, IN(PrecisePoint) p) {
    PrecisePoint result;
    transform_by_row(m.high_x, m.low_x, p, result.high.x, result.low.x);
    transform_by_row(m.high_y, m.low_y, p, result.high.y, result.low.y);
    transform_by_row(m.high_z, m.low_z, p, result.high.z, result.low.z);
    return result;
}

// A unit normal by the transform of a node; zero stays zero.
FN vec3 transformed_normal(IN(PoseMatrix) m, vec3 normal) {
    real unused = real(0.0);
    return unit_and_length(vec3(dot3(vec3(m.normal_x), normal), dot3(vec3(m.normal_y), normal),
                                dot3(vec3(m.normal_z), normal)),
                           unused);
}

// The linear part of a transform that joints blend, by rows.
struct BlendedRows {
    vec3 x, y, z;
};

FN void add_weighted(INOUT(BlendedRows) sum, float32 weight, IN(PoseMatrix) m) {
    sum.x += weight * vec3(m.high_x);
    sum.y += weight * vec3(m.high_y);
    sum.z += weight * vec3(m.high_z);
}

// A unit normal by a blended transform: by its cofactors, whose rows are the cross products of its
// rows.
FN vec3 transformed_normal(IN(BlendedRows) rows, vec3 normal) {
    real largest = max(max(max_component(abs(rows.x)), max_component(abs(rows.y))),
                       max_component(abs(rows.z)));
    if (!is_finite(largest) || !(largest > real(0.0))) {
        return vec3(real(0.0));
    }
    vec3 x = rows.x / largest; // so that products neither overflow nor vanish
    vec3 y = rows.y / largest;
    vec3 z = rows.z / largest;
    vec3 yz = cross3(y, z);
    real side = dot3(x, yz) < real(0.0) ? real(-1.0) : real(1.0);
    real unused = real(0.0);
    return unit_and_length(
        side * vec3(dot3(yz, normal), dot3(cross3(z, x), normal), dot3(cross3(x, y), normal)),
        unused);
}

ARGAND_SHARED_END

#endif
