#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/area_records.h"
#include "shared/fixed_point.h"
#include "shared/photon_records.h"

layout(set = 0, binding = 0) readonly buffer Pieces { uvec2 pieces[]; };
layout(set = 0, binding = 1) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 2) readonly buffer LowSums { uint low_sums[]; };
layout(set = 0, binding = 3) readonly buffer HighSums { uint high_sums[]; };
layout(set = 0, binding = 4) writeonly buffer AreaSums { AreaSumRecord area_sums[]; };
layout(push_constant) uniform Push { AreaSumParams params; };

#include "shared/kernels/world/area_table.h"
