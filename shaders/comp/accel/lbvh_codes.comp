#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"
#include "shared/morton.h"

layout(set = 0, binding = 0) readonly buffer Boxes { vec4 boxes[]; };
layout(set = 0, binding = 1) readonly buffer Bounds { vec4 bounds[]; };
layout(set = 0, binding = 2) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 3) writeonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 4) writeonly buffer Order { uint order[]; };
layout(push_constant) uniform Push { AccelParams params; };

#include "shared/kernels/accel/lbvh_codes.h"
