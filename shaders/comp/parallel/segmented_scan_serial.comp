#version 460
layout(local_size_x = 8) in;
#include "kernel.glsl"
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer In { uint in_elements[]; };
layout(set = 0, binding = 1) readonly buffer Heads { uint heads[]; };
layout(set = 0, binding = 2) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 3) readonly buffer Totals { uvec2 part_totals[]; };
layout(set = 0, binding = 4) writeonly buffer Out { uint out_elements[]; };
layout(push_constant) uniform Push { SegmentParams params; };
#include "parallel/parts.glsl"

// One part per lane.
void main() {
    if (THREAD_INDEX >= params.parts.parts) {
        return;
    }
    uint sum = 0u;
    for (uint part = 0u; part < THREAD_INDEX; ++part) {
        uvec2 total = part_totals[part];
        sum = total.y != 0u ? total.x : sum + total.x;
    }
    uvec2 range = part_range(THREAD_INDEX, element_count());
    for (uint i = range.x; i < range.y; ++i) {
        sum = in_elements[i] + (heads[i] != 0u ? 0u : sum);
        out_elements[i] = sum;
    }
}
