// The width of the part of a surface for which a path stands: a cone around each ray (Amanatides
// 1984, "Ray Tracing with Cones"). It chooses the mip level of textures.
#ifndef ARGAND_SHARED_RAY_CONE_H
#define ARGAND_SHARED_RAY_CONE_H

#include "shared/maths.h"

ARGAND_SHARED_BEGIN

// Wider cones would say nothing about neighbouring paths.
CONSTANT real LARGEST_CONE_SPREAD = real(0.2);

// Width at the ray's origin, and its growth per unit of distance: the upper halves of two floats,
// which lie in RayRecord::pad. 0: nothing is filtered.
FN uint pack_cone(real width, real spread) {
    return (float_bits(float32(width)) >> 16u) | (float_bits(float32(spread)) & 0xffff0000u);
}
FN real cone_spread(uint cone) { return real(bits_float(cone & 0xffff0000u)); }
FN real cone_width(uint cone, real t) {
    return real(bits_float(cone << 16u)) + cone_spread(cone) * t;
}

// Distance between the directions of neighbouring ones among so many paths, of this density over
// directions, added to a spread that is independent of it. pdf 0: a smooth surface scatters.
FN real scattered_spread(real spread, real paths, real pdf) {
    real added = pdf > real(0.0) ? real(1.0) / (max(paths, real(1.0)) * pdf) : real(0.0);
    return min(sqrt(spread * spread + added), LARGEST_CONE_SPREAD);
}

ARGAND_SHARED_END

#endif
