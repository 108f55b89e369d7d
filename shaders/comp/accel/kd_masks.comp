#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/kdtree_build.h"

layout(set = 0, binding = 0) readonly buffer Nodes { KdNode nodes[]; };
layout(set = 0, binding = 1) readonly buffer Active { uint active_nodes[]; };
layout(set = 0, binding = 2) readonly buffer Finished { uint finished[]; };
layout(set = 0, binding = 3) readonly buffer Elements { uvec4 elements[]; };
layout(set = 0, binding = 4) writeonly buffer LeftMasks { uint left_masks[]; };
layout(set = 0, binding = 5) writeonly buffer RightMasks { uint right_masks[]; };
layout(push_constant) uniform Push { KdBuildParams params; };
// Lanes of an element: 1 for a point, 2 for a box. The first lane ends with its index.
layout(constant_id = 0) const uint lanes = 2u;

#include "shared/kernels/accel/kd_masks.h"
