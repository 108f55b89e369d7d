#include "accel/traverse.glsl"

//@ holds(hits, HitRecord)
layout(set = 0, binding = 7) buffer Hits { uvec4 hits[]; };
#define ALPHA_BINDING 8
#include "alpha_bindings.glsl"

#include "shared/kernels/accel/trace_closest_alpha.h"
