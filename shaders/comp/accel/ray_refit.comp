#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"
#include "shared/geometry_records.h"
#include "shared/maths.h"

layout(set = 0, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };
layout(set = 0, binding = 2) readonly buffer Order { uint order[]; };
// See ray_parents.comp.
layout(set = 0, binding = 3) readonly buffer Parents { uint parents[]; };
// Children of each node that are fitted; 0 beforehand.
layout(set = 0, binding = 4) coherent buffer Arrivals { uint arrivals[]; };
// Of each node and triangle, by its reference: low and cost, high.
layout(set = 0, binding = 5) coherent buffer Boxes { vec4 boxes[]; };
//@ holds(nodes, RayNode)
layout(set = 0, binding = 6) buffer Nodes { uvec4 nodes[]; };
layout(set = 0, binding = 7) writeonly buffer Out { vec4 leaf_triangles[]; };
layout(push_constant) uniform Push { AccelParams params; };

#include "memory_fence.glsl"
#include "shared/kernels/accel/ray_refit.h"
