// Points on a triangle that shines by its texels are chosen by a density that is constant in the
// cells into which a tree halves the unit square of the random numbers of sample_triangle(). Random
// numbers are warped on their way down the tree (Clarberg et al. 2005, "Wavelet Importance
// Sampling", section 4.2), which keeps them evenly distributed. Kernels read the nodes
// (kernels/texels.h).
//
// A node has two words. The first is 0 for a leaf, else twice the word at which its two children
// begin, plus the number that it halves. The second is the lower child's share of the points, as
// the bits of a float.
#ifndef ARGAND_SHARED_TEXEL_TREE_H
#define ARGAND_SHARED_TEXEL_TREE_H

#include "shared/maths.h"

ARGAND_SHARED_BEGIN

CONSTANT uint words_of_texel_node = 2u;
CONSTANT uint most_texel_levels = 40u;

// Two numbers on their way down a tree.
struct TexelNumbers {
    vec2 u;         // where in the cell, in [0,1)
    vec2 low, size; // the cell
    real density;   // of points in the cell over that on the whole triangle
};

FN TexelNumbers begin_texels(vec2 u) {
    TexelNumbers n;
    n.u = u;
    n.low = vec2(real(0.0));
    n.size = vec2(real(1.0));
    n.density = real(1.0);
    return n;
}

// Goes on to one half of the cell.
FN void halve_cell(uint axis, bool upper, real inside, real share, INOUT(TexelNumbers) n) {
    inside = min(inside, LARGEST_BELOW_1);
    n.density *= real(2.0) * (upper ? real(1.0) - share : share);
    if (axis == 0u) {
        n.size.x *= real(0.5);
        n.low.x += upper ? n.size.x : real(0.0);
        n.u.x = inside;
    } else {
        n.size.y *= real(0.5);
        n.low.y += upper ? n.size.y : real(0.0);
        n.u.y = inside;
    }
}

// Goes on to the child that the numbers choose by its share. Returns whether it is the upper one.
FN bool descend_by_share(uint axis, real share, INOUT(TexelNumbers) n) {
    real u = axis == 0u ? n.u.x : n.u.y;
    bool upper = u >= share;
    real inside = upper ? (u - share) / (real(1.0) - share) : u / share;
    halve_cell(axis, upper, inside, share, n);
    return upper;
}

// Goes on to the child in which the numbers lie. Returns whether it is the upper one.
FN bool descend_by_place(uint axis, real share, INOUT(TexelNumbers) n) {
    real u = real(2.0) * (axis == 0u ? n.u.x : n.u.y);
    bool upper = u >= real(1.0);
    halve_cell(axis, upper, upper ? u - real(1.0) : u, share, n);
    return upper;
}

// The numbers in the whole square, in [0,1).
FN vec2 end_texels(IN(TexelNumbers) n) { return min(n.low + n.size * n.u, vec2(LARGEST_BELOW_1)); }

// The numbers for which sample_triangle() gives these weights of the second and third vertex.
FN vec2 numbers_of_point(real b1, real b2) {
    real root = clamp(b1 + b2, real(0.0), real(1.0));
    return min(
        vec2(root * root, b2 > real(0.0) ? clamp(b2 / root, real(0.0), real(1.0)) : real(0.0)),
        vec2(LARGEST_BELOW_1));
}

ARGAND_SHARED_END

#endif
