#version 460
layout(local_size_x = 128) in;
#include "kernel.glsl"
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer In { uint in_elements[]; };
layout(set = 0, binding = 1) readonly buffer Heads { uint heads[]; };
layout(set = 0, binding = 2) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 3) writeonly buffer Totals { uvec2 part_totals[]; };
layout(push_constant) uniform Push { SegmentParams params; };
#include "parallel/parts.glsl"
#include "parallel/group_reduce.glsl"

// Writes for each part the sum from its last head on, and whether it has a head. One part per
// group.
void main() {
    uint lane = gl_LocalInvocationIndex;
    uvec2 range = part_range(GROUP_INDEX, element_count());
    uint last_head = 0u;        // its index plus one; 0: none
    for (uint i = range.x + lane; i < range.y; i += gl_WorkGroupSize.x) {
        last_head = heads[i] != 0u ? i + 1u : last_head;
    }
    last_head = group_max(last_head);
    uint sum = 0u;
    for (uint i = (last_head > 0u ? last_head - 1u : range.x) + lane; i < range.y; i += gl_WorkGroupSize.x) {
        sum += in_elements[i];
    }
    sum = group_sum(sum);
    if (lane == 0u && GROUP_INDEX < params.parts.parts) {
        part_totals[GROUP_INDEX] = uvec2(sum, min(last_head, 1u));
    }
}
