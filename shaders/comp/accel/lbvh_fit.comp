#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"
#include "shared/morton.h"

layout(set = 0, binding = 0) readonly buffer Boxes { vec4 boxes[]; };
// See code_distances.comp.
layout(set = 0, binding = 1) readonly buffer Distances { uint distances[]; };
layout(set = 0, binding = 2) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 3) readonly buffer Counts { uint counts[]; };
// Which of two siblings arrives first at their parent depends on scheduling.
//@ incidental(ends)
layout(set = 0, binding = 4) coherent buffer Ends { uint ends[]; };
//@ holds(nodes, LbvhNode)
layout(set = 0, binding = 5) coherent buffer Nodes { uvec4 nodes[]; };
//@ holds(costs, ForestCost)
layout(set = 0, binding = 6) coherent buffer Costs { uvec4 costs[]; };
layout(set = 0, binding = 7) writeonly buffer Parents { uint parents[]; };
layout(push_constant) uniform Push { AccelParams params; };

#include "memory_fence.glsl"

// For trees that rays traverse: also writes a ForestCost and a parent for each inner node. The
// parent is 2 p for the left child of inner node p, 2 p + 1 for the right one, and lbvh_end for the
// root.
layout(constant_id = 1) const bool for_rays = false;
// Whether the boxes are in the order of their codes already. Then leaves get `order`, but no box is
// looked up through it.
layout(constant_id = 2) const bool in_order = false;

#include "shared/kernels/accel/lbvh_fit.h"
