#ifndef ARGAND_SHARED_AIM_RECORDS_H
#define ARGAND_SHARED_AIM_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// The axis of a node without children.
CONSTANT uint aim_leaf = 4u;
// Trees are no deeper.
CONSTANT uint most_aim_levels = 48u;

// Of a tree's photons, those that are spread evenly over the hypercube. No box has a concentration
// below this.
CONSTANT real aim_even_share = real(0.25);

// A node of the trees of aim.h: a box of the unit hypercube, divided in two across an axis. The
// children follow one another.
struct AimNode {
    uint axis;     // 0 to 3, or aim_leaf
    uint child;    // index of the lower child
    float32 cut;   // size of the lower child over the node's, in (0,1)
    float32 share; // of the node's photons that start in the lower child, in (0,1)
};

ARGAND_SHARED_END

#endif
