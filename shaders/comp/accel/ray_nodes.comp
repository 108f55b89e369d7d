#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"

layout(set = 0, binding = 0) readonly buffer Tree { uvec4 tree[]; };
layout(set = 0, binding = 1) readonly buffer Costs { uvec4 costs[]; };
layout(set = 0, binding = 2) readonly buffer Ranks { uint ranks[]; };
layout(set = 0, binding = 3) writeonly buffer Nodes { uvec4 nodes[]; };
layout(push_constant) uniform Push { AccelParams params; };

#include "shared/kernels/accel/ray_nodes.h"
