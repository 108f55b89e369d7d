#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"
#include "shared/morton.h"

layout(set = 0, binding = 0) readonly buffer Boxes { vec4 boxes[]; };
layout(set = 0, binding = 1) readonly buffer Distances { uint distances[]; };    // see code_distances.comp
layout(set = 0, binding = 2) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 3) readonly buffer Counts { uint counts[]; };
// Which of two children comes first to their parent.
//@ incidental(ends)
layout(set = 0, binding = 4) coherent buffer Ends { uint ends[]; };
//@ holds(nodes, LbvhNode)
layout(set = 0, binding = 5) coherent buffer Nodes { uvec4 nodes[]; };
//@ holds(costs, ForestCost)
layout(set = 0, binding = 6) coherent buffer Costs { uvec4 costs[]; };
layout(set = 0, binding = 7) writeonly buffer Parents { uint parents[]; };
layout(push_constant) uniform Push { AccelParams params; };

// Off where atomics are sequentially consistent anyway: lavapipe 22.3 takes a memory barrier for a control barrier, and
// in a loop that not all invocations run equally often loses its place.
layout(constant_id = 0) const bool fences = true;

// For trees that rays will traverse: also writes ForestCost per inner node, and as its parent 2 p if it is the left child
// of inner node p, 2 p + 1 if it is the right one (lbvh_end: it is the root).
layout(constant_id = 1) const bool for_rays = false;
// Whether the boxes are in the order of their codes; `order` then is only what leaves refer to.
layout(constant_id = 2) const bool in_order = false;

#define MEMORY_FENCE() \
    if (fences) {      \
        memoryBarrierBuffer(); \
    }
#include "shared/kernels/accel/lbvh_fit.h"
