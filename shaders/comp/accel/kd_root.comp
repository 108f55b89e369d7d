#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/kdtree_build.h"

layout(set = 0, binding = 0) readonly buffer Boxes { vec4 boxes[]; };
layout(set = 0, binding = 1) writeonly buffer Nodes { KdNode nodes[]; };
layout(set = 0, binding = 2) writeonly buffer Cells { BoxRecord cells[]; };
layout(push_constant) uniform Push { KdBuildParams params; };

#include "shared/kernels/accel/kd_root.h"
