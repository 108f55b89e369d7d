#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"

layout(set = 0, binding = 0) readonly buffer Nodes { uvec4 nodes[]; };
layout(set = 0, binding = 1) readonly buffer NodeCount { uint node_count[]; };
// Of each child, by its reference; lbvh_end beforehand, which the root keeps.
layout(set = 0, binding = 2) writeonly buffer Parents { uint parents[]; };

#include "shared/kernels/accel/ray_parents.h"
