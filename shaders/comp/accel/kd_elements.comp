#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/kdtree_build.h"

layout(set = 0, binding = 0) readonly buffer Boxes { vec4 boxes[]; };
layout(set = 0, binding = 1) writeonly buffer Elements { uvec4 elements[]; };
layout(set = 0, binding = 2) writeonly buffer Segments { uint segments[]; };
layout(set = 0, binding = 3) writeonly buffer Finished { uint finished[]; };
layout(set = 0, binding = 4) writeonly buffer FinishedNodes { uint finished_nodes[]; };
layout(push_constant) uniform Push { KdBuildParams params; };
// Lanes of an element: 1 for a point, 2 for a box. The first lane ends with its index.
layout(constant_id = 0) const uint lanes = 2u;

#include "shared/kernels/accel/kd_elements.h"
