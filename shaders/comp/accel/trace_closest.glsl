#include "accel/traverse.glsl"

//@ holds(hits, HitRecord)
layout(set = 0, binding = 7) buffer Hits { uvec4 hits[]; };

#include "shared/kernels/accel/trace_closest.h"
