// Photons from outside are aimed by a density over the random numbers that decide their direction
// and where they start. It is constant in the boxes into which a tree divides the unit hypercube.
// Random numbers are warped on their way down the tree (Clarberg et al. 2005, "Wavelet Importance
// Sampling", section 4.2), which keeps them evenly distributed.
#ifndef ARGAND_SHARED_AIM_H
#define ARGAND_SHARED_AIM_H

#include "shared/aim_records.h"
#include "shared/maths.h"

ARGAND_SHARED_BEGIN

// Random numbers on their way down a tree.
struct AimedNumbers {
    vec4 u;             // where in the box, in [0,1)
    vec4 low, size;     // the box
    real concentration; // density of numbers in the box over that in the whole hypercube
};

FN AimedNumbers begin_aim(vec4 u) {
    AimedNumbers a;
    a.u = u;
    a.low = vec4(real(0.0));
    a.size = vec4(real(1.0));
    a.concentration = real(1.0);
    return a;
}

// Goes on to a child of the node. Returns whether it is the upper one.
FN bool descend_aim(IN(AimNode) node, INOUT(AimedNumbers) a) {
    vec4 along = vec4(real(0.0));
    along.x = node.axis == 0u ? real(1.0) : real(0.0);
    along.y = node.axis == 1u ? real(1.0) : real(0.0);
    along.z = node.axis == 2u ? real(1.0) : real(0.0);
    along.w = node.axis == 3u ? real(1.0) : real(0.0);
    real u = dot(a.u, along);
    real cut = real(node.cut);
    real share = real(node.share);
    bool upper = u >= share;
    if (upper) {
        a.low += along * (dot(a.size, along) * cut);
        u -= share;
        cut = real(1.0) - cut;
        share = real(1.0) - share;
    }
    real inside = min(u / share, LARGEST_BELOW_1);
    a.u += along * (inside - dot(a.u, along));
    a.size *= vec4(real(1.0)) - along * (real(1.0) - cut);
    a.concentration *= share / cut;
    return upper;
}

// The numbers in the whole hypercube, in [0,1).
FN vec4 end_aim(IN(AimedNumbers) a) { return min(a.low + a.size * a.u, vec4(LARGEST_BELOW_1)); }

ARGAND_SHARED_END

#endif
