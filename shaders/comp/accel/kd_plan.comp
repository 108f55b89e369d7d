#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/kdtree_build.h"

layout(set = 0, binding = 0) readonly buffer Nodes { KdNode nodes[]; };
layout(set = 0, binding = 1) readonly buffer Tight { vec4 tight[]; };
layout(set = 0, binding = 2) writeonly buffer Plans { KdPlanes plans[]; };
layout(set = 0, binding = 3) writeonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 4) readonly buffer Cells { BoxRecord cells[]; };
layout(push_constant) uniform Push { KdBuildParams params; };

#include "shared/kernels/accel/kd_plan.h"
