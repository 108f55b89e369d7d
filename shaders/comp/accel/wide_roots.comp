#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"

layout(set = 0, binding = 0) readonly buffer Costs { uvec4 costs[]; };
layout(set = 0, binding = 1) readonly buffer Parents { uint parents[]; };
layout(set = 0, binding = 2) writeonly buffer Roots { uint roots[]; };
layout(push_constant) uniform Push { AccelParams params; };

#include "shared/kernels/accel/wide_roots.h"
