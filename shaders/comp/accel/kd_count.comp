#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/kdtree_build.h"

layout(set = 0, binding = 0) readonly buffer References { uvec4 references[]; };
layout(set = 0, binding = 1) readonly buffer Segments { uint segments[]; };
layout(set = 0, binding = 2) readonly buffer Plans { KdPlanes plans[]; };
layout(set = 0, binding = 3) buffer Counts { uint counts[]; };
layout(push_constant) uniform Push { KdBuildParams params; };
// Lanes of an element: 1 for a point, 2 for a box. The first lane ends with its index.
layout(constant_id = 0) const uint lanes = 2u;

#include "shared/kernels/accel/kd_count.h"
