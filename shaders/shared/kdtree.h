// The kd-tree: how it lies in memory, and the rules by which it is built. Zhou, Hou, Wang and Guo
// 2008, "Real-time kd-tree construction on graphics hardware"; Shi 2012, sections 2.5.1 and 3.4.1.
#ifndef ARGAND_SHARED_KDTREE_H
#define ARGAND_SHARED_KDTREE_H

#include "shared/maths.h"

ARGAND_SHARED_BEGIN

// A tree is an array of words in depth-first order, the root at 0. A node begins with its index. A
// parent goes on with two words, its axis (0 to 2) in the two highest bits above the address of its
// right child, and the place of its plane as the bits of a float; then come its left child and all
// below it. A leaf, whose index has the highest bit set, goes on with the number of its elements
// and their indices, in ascending order.
//
// Leaves have the indices 0 to n - 1 from left to right, parents n to 2 n - 2 in depth-first order.
CONSTANT uint kd_leaf = 0x80000000u;
CONSTANT uint kd_most_words = 0x40000000u; // an address has 30 bits
CONSTANT uint kd_parent_words = 3u;
CONSTANT uint kd_leaf_words = 2u; // without its elements

FN bool kd_is_leaf(uint first_word) { return first_word >= kd_leaf; }
FN uint kd_node_index(uint first_word) { return first_word & ~kd_leaf; }
FN uint kd_axis(uint parent_word) { return parent_word >> 30u; }
FN uint kd_right_child(uint parent_word) { return parent_word & (kd_most_words - 1u); }
FN uint kd_left_child(uint address) { return address + kd_parent_words; }
FN uint kd_parent_word(uint axis, uint right_child) { return axis << 30u | right_child; }

// The most planes above a leaf.
CONSTANT uint kd_most_depth = 62u;

// A ray's slot in Traversal::suspended: its position in so many words, three words for each node on
// its stack, the triangle and distance of the hit behind which the ray goes on, and the closest hit
// of a shadow ray that surfaces let pass.
CONSTANT uint kd_suspended_words = 7u;
CONSTANT uint kd_suspended_passed = 7u + 3u * kd_most_depth;
CONSTANT uint kd_suspended_layer = kd_suspended_passed + 2u;
CONSTANT uint kd_suspended_stride = kd_suspended_layer + 4u;

// Nodes of at most so many elements are small: bits of one word stand for the elements.
CONSTANT uint kd_small = 32u;

// Cost of visiting a node, relative to that of an element; and what a second reference to an
// element must save. Without the latter n boxes that overlap take n^2 references, and save next to
// nothing.
CONSTANT real kd_visit_cost = real(1.5);
CONSTANT real kd_copy_cost = real(0.1);

struct KdRules {
    uint points;     // not 0: elements are points, parted by the voxel-volume heuristic
    float32 reach;   // of searches for points; volumes are larger by it on every side
    uint leaf_size;  // nodes of so many elements are leaves
    uint most_depth; // at most kd_most_depth
};

FN real kd_at(vec3 v, uint axis) { return axis == 0u ? v.x : axis == 1u ? v.y : v.z; }
FN vec3 kd_with(vec3 v, uint axis, real x) {
    return vec3(axis == 0u ? x : v.x, axis == 1u ? x : v.y, axis == 2u ? x : v.z);
}

// Cells are half open: a plane parts space into x < split and x >= split, so that a point is on one
// side. The root's cell ends just above its elements. An element is on each side that its box
// meets.
FN bool kd_is_left(real low, real split) { return low < split; }
FN bool kd_is_right(real high, real split) { return !(high < split); }

// Every device must come to the same tree, whether it keeps subnormal numbers or not. So
// coordinates less than 2^-100 count as zero. The others, and their differences, are multiples of
// 2^-123. Nothing overflows up to 2^125.
CONSTANT real kd_least = real(7.888609052210118e-31);   // 2^-100
CONSTANT real kd_largest = real(4.253529586511731e+37); // 2^125

FN real kd_flushed(real x) { return abs(x) < kd_least ? real(0.0) : x; }

// A side of an element's box, whatever it was.
FN real kd_coordinate(real x) {
    uint size = float_bits(float32(x)) & 0x7fffffffu;
    return size > 0x7f800000u ? real(0.0) : kd_flushed(clamp(x, -kd_largest, kd_largest));
}
FN vec3 kd_position(vec3 p) {
    return vec3(kd_coordinate(p.x), kd_coordinate(p.y), kd_coordinate(p.z));
}

// The least coordinate above x. A plane there has all elements that end at x on its left.
FN real kd_above(real x) {
    uint bits = float_bits(float32(x));
    real next = bits_float(x > real(0.0) ? bits + 1u : bits - 1u);
    return x == real(0.0) ? kd_least : kd_flushed(next);
}
FN vec3 kd_just_above(vec3 p) { return vec3(kd_above(p.x), kd_above(p.y), kd_above(p.z)); }

// The middle, or `low` if there are too few numbers between.
FN real kd_middle(real low, real high) {
    real middle = kd_flushed(real(0.5) * low + real(0.5) * high);
    bool between = low < middle && middle < high && high - low > real(2.0) * kd_least;
    return between ? middle : low;
}

// A plane. axis: 3 for none.
struct KdPlane {
    uint axis;
    real split;
};

// The plane that cuts off the longest empty part of a cell beside the box of its elements, if that
// is longer than a quarter of the cell.
FN KdPlane kd_cut(vec3 low, vec3 high, vec3 box_low, vec3 box_high) {
    KdPlane plane;
    plane.axis = 3u;
    plane.split = real(0.0);
    real longest = real(0.0);
    for (uint axis = 0u; axis < 3u; ++axis) {
        real cell_low = kd_at(low, axis);
        real cell_high = kd_at(high, axis);
        real least = real(0.25) * (cell_high - cell_low);
        real below = kd_at(box_low, axis) - cell_low;
        if (below > least && below > longest) {
            longest = below;
            plane.axis = axis;
            plane.split = kd_at(box_low, axis);
        }
        real end = kd_above(kd_at(box_high, axis));
        real above = cell_high - end;
        if (above > least && above > longest) {
            longest = above;
            plane.axis = axis;
            plane.split = end;
        }
    }
    return plane;
}

// The axes from the longest to the shortest: k = 0 to 2.
FN uint kd_longest(vec3 size, uint k) {
    uint first = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
    uint last = size.z <= size.x && size.z <= size.y ? 2u : size.y <= size.x ? 1u : 0u;
    return k == 0u ? first : k == 2u ? last : 3u - first - last;
}

// A cell whose parts are compared. Its sides are scaled by a power of two, which is exact, so that
// the longest is between 1 and 2, and short ones are 2^-30, so that flat cells have a volume and no
// product underflows.
struct KdSpace {
    vec3 low, high;
    vec3 sides;
    real scale;
};

CONSTANT real kd_least_side = real(9.313225746154785e-10); // 2^-30

FN KdSpace kd_space(vec3 low, vec3 high, IN(KdRules) rules) {
    KdSpace space;
    space.low = low;
    space.high = high;
    vec3 size = high - low + real(2.0) * rules.reach;
    // Its reciprocal's exponent, from 1 to 227.
    uint exponent = float_bits(float32(max(max_component(size), kd_least))) >> 23u;
    space.scale = bits_float((254u - exponent) << 23u);
    space.sides = max(size * space.scale, vec3(kd_least_side));
    return space;
}

FN real kd_measure(vec3 sides, IN(KdRules) rules) {
    return rules.points != 0u ? sides.x * sides.y * sides.z
                              : sides.x * sides.y + sides.y * sides.z + sides.z * sides.x;
}

// Area or volume of the part of a cell that is `length` long along an axis.
FN real kd_part(IN(KdSpace) space, uint axis, real length, IN(KdRules) rules) {
    real side = max((length + real(2.0) * rules.reach) * space.scale, kd_least_side);
    return kd_measure(kd_with(space.sides, axis, side), rules);
}

// Costs of a node whose elements are all visited, and of one with a plane.
FN real kd_cost(IN(KdSpace) space, uint elements, IN(KdRules) rules) {
    return kd_measure(space.sides, rules) * real(elements);
}
FN real kd_plane_cost(IN(KdSpace) space, KdPlane plane, uint elements, uint lefts, uint rights,
                      IN(KdRules) rules) {
    real below = plane.split - kd_at(space.low, plane.axis);
    real above = kd_at(space.high, plane.axis) - plane.split;
    real copies = real(lefts + rights - elements);
    return kd_measure(space.sides, rules) * (kd_visit_cost + kd_copy_cost * copies) +
           (kd_part(space, plane.axis, below, rules) * real(lefts) +
            kd_part(space, plane.axis, above, rules) * real(rights));
}

// Whether a plane of a node's candidates may be taken: it lies within the cell, and parts points.
FN bool kd_is_candidate(IN(KdSpace) space, KdPlane plane, uint lefts, uint rights,
                        IN(KdRules) rules) {
    return kd_at(space.low, plane.axis) < plane.split &&
           plane.split < kd_at(space.high, plane.axis) &&
           (rules.points == 0u || (lefts > 0u && rights > 0u));
}

// What a node may cost with a plane. Points are always parted.
FN real kd_cost_to_beat(IN(KdSpace) space, uint elements, IN(KdRules) rules) {
    return rules.points != 0u ? real(3.0e38) : kd_cost(space, elements, rules);
}

ARGAND_SHARED_END

#endif
