#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/area_records.h"

layout(set = 0, binding = 0) readonly buffer LowSums { uint low_sums[]; };
layout(set = 0, binding = 1) buffer Highs { uint highs[]; };
layout(push_constant) uniform Push { AreaSumParams params; };

#include "shared/kernels/world/area_carries.h"
