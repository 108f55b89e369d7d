#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/kdtree_build.h"

layout(set = 0, binding = 0) buffer Nodes { KdNode nodes[]; };
layout(set = 0, binding = 1) readonly buffer Choices { KdChoice choices[]; };
layout(set = 0, binding = 2) readonly buffer SplitSums { uint split_sums[]; };
layout(set = 0, binding = 3) readonly buffer NextSums { uint next_sums[]; };
layout(set = 0, binding = 4) readonly buffer FinishedSums { uint finished_sums[]; };
layout(set = 0, binding = 5) buffer Cells { BoxRecord cells[]; };
layout(push_constant) uniform Push { KdBuildParams params; };

#include "shared/kernels/accel/kd_split.h"
