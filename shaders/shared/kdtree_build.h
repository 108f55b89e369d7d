// Records and functions of the build of a kd-tree on a device.
#ifndef ARGAND_SHARED_KDTREE_BUILD_H
#define ARGAND_SHARED_KDTREE_BUILD_H

#include "shared/geometry_records.h"
#include "shared/kdtree.h"
#include "shared/segments.h"

ARGAND_SHARED_BEGIN

CONSTANT uint kd_no_axis = 3u;    // of a leaf
CONSTANT uint kd_any_middle = 4u; // see KdPlanes

// A node of a tree that is being built; its cell is kept apart. A large node refers to `count`
// elements; a small one to those elements of its root, the small node from which it descends, whose
// bits are set.
struct KdNode {
    uint axis; // kd_no_axis: a leaf so far
    float32 split;
    uint first; // references, of a small node its root's
    uint count; // of elements, and in the end of those in the leaves below
    uint bits;
    uint left; // index of the left child; the right one is behind it
    uint depth;
    uint leaves; // below it
};

// Planes of a large node. kind: an axis, where `split` is that of a plane which cuts off empty
// space; kd_any_middle, where one of the three is taken; or kd_no_axis.
struct KdPlanes {
    uint kind;
    float32 split_x, split_y, split_z;
};

// The plane that a node of a level takes. left, right: the children's numbers of elements, or their
// bits if the node is small.
struct KdChoice {
    uint axis;
    float32 split;
    uint left, right;
};

// Where a node is written: address, number of the first leaf below it, and number of the parents
// before it.
struct KdPlace {
    uint address, leaf, parent;
    uint pad0;
};

struct KdBuildParams {
    uint first, end; // nodes of a level, or elements
    uint nodes;      // so far; children come behind
    uint finished;   // references so far to elements of nodes that are no longer large
    KdRules rules;
    uint stop; // not 0: no node is split
    uint leaf_count;
    uint pad0, pad1;
};

// Counters of a level: indices into an array of uint.
CONSTANT uint kd_splits = 0u;
CONSTANT uint kd_growth = 1u; // of the references
CONSTANT uint kd_next = 2u;   // references of large children
CONSTANT uint kd_finished = 3u;
CONSTANT uint kd_counters = 4u;

FN vec3 kd_low(IN(BoxRecord) cell) { return vec3(cell.low_x, cell.low_y, cell.low_z); }
FN vec3 kd_high(IN(BoxRecord) cell) { return vec3(cell.high_x, cell.high_y, cell.high_z); }
FN BoxRecord kd_cell(vec3 low, vec3 high) {
    BoxRecord cell;
    cell.low_x = low.x;
    cell.low_y = low.y;
    cell.low_z = low.z;
    cell.pad0 = real(0.0);
    cell.high_x = high.x;
    cell.high_y = high.y;
    cell.high_z = high.z;
    cell.pad1 = real(0.0);
    return cell;
}

FN bool kd_is_done(uint elements, uint depth, IN(KdRules) rules) {
    return elements <= rules.leaf_size || depth >= rules.most_depth;
}

FN uint kd_bit_count(uint x) {
    x = x - ((x >> 1u) & 0x55555555u);
    x = (x & 0x33333333u) + ((x >> 2u) & 0x33333333u);
    return (((x + (x >> 4u)) & 0x0f0f0f0fu) * 0x01010101u) >> 24u;
}

FN uint kd_bits_of(uint count) { return count == 32u ? 0xffffffffu : (1u << count) - 1u; }

// Candidates of an element: planes along each axis, at its lower end, and just above its upper one.
FN uint kd_candidates(IN(KdRules) rules) { return rules.points != 0u ? 3u : 6u; }
FN KdPlane kd_candidate(uint which, vec3 low, vec3 high, IN(KdRules) rules) {
    bool ends = rules.points == 0u;
    KdPlane plane;
    plane.axis = ends ? which >> 1u : which;
    plane.split =
        ends && (which & 1u) != 0u ? kd_above(kd_at(high, plane.axis)) : kd_at(low, plane.axis);
    return plane;
}

FN BoxRecord kd_part_of(IN(BoxRecord) cell, IN(KdChoice) choice, bool is_left) {
    vec3 low = kd_low(cell);
    vec3 high = kd_high(cell);
    return is_left ? kd_cell(low, kd_with(high, choice.axis, choice.split))
                   : kd_cell(kd_with(low, choice.axis, choice.split), high);
}

FN KdNode kd_leaf_node(uint first, uint count, uint bits, uint depth) {
    KdNode node;
    node.axis = kd_no_axis;
    node.split = real(0.0);
    node.first = first;
    node.count = count;
    node.bits = bits;
    node.left = 0u;
    node.depth = depth;
    node.leaves = 1u;
    return node;
}

ARGAND_SHARED_END

#endif
