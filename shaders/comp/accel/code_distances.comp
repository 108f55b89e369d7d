#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"
#include "shared/morton.h"

layout(set = 0, binding = 0) readonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) writeonly buffer Distances { uint distances[]; };
layout(push_constant) uniform Push { AccelParams params; };

layout(constant_id = 0) const bool codes64 = false;  // codes of 64 bits; else of 32

#include "shared/kernels/accel/code_distances.h"
