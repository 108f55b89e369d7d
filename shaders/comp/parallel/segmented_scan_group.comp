#version 460
layout(local_size_x = 128) in;
#include "kernel.glsl"
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer In { uint in_elements[]; };
layout(set = 0, binding = 1) readonly buffer Heads { uint heads[]; };
layout(set = 0, binding = 2) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 3) readonly buffer Totals { uvec2 part_totals[]; };
layout(set = 0, binding = 4) writeonly buffer Out { uint out_elements[]; };
layout(push_constant) uniform Push { SegmentParams params; };
#include "parallel/parts.glsl"
#include "parallel/group_reduce.glsl"

#define ITEMS 4u
#define TILE (ITEMS * gl_WorkGroupSize.x)

shared uvec2 sums[2u * gl_WorkGroupSize.x];

// Joins the sums of neighbouring ranges: x is the sum from the last head on, y whether there is a
// head (Sengupta et al. 2007, "Scan primitives for GPU computing").
uvec2 join(uvec2 before, uvec2 after) {
    return uvec2(after.x + (after.y != 0u ? 0u : before.x), before.y | after.y);
}

// The sum with which the part begins. Parts before the last one with a head do not matter.
uint sum_before(uint part, uint lane) {
    uint last_head = 0u;
    for (uint i = lane; i < part; i += gl_WorkGroupSize.x) {
        last_head = part_totals[i].y != 0u ? i + 1u : last_head;
    }
    last_head = group_max(last_head);
    uint sum = 0u;
    for (uint i = max(last_head, 1u) - 1u + lane; i < part; i += gl_WorkGroupSize.x) {
        sum += part_totals[i].x;
    }
    return group_sum(sum);
}

// The scan of Hillis and Steele (1986), which alternates between the halves of `sums`. Returns the
// sums of the lanes before this one; total: of all.
uvec2 scan_lanes(uvec2 mine, uint lane, out uvec2 total) {
    uint half_at = 0u;
    barrier();
    sums[lane] = mine;
    for (uint step = 1u; step < gl_WorkGroupSize.x; step <<= 1u) {
        barrier();
        if (lane >= step) {
            mine = join(sums[half_at + lane - step], mine);
        }
        half_at = gl_WorkGroupSize.x - half_at;
        sums[half_at + lane] = mine;
    }
    barrier();
    total = sums[half_at + gl_WorkGroupSize.x - 1u];
    return lane > 0u ? sums[half_at + lane - 1u] : uvec2(0u);
}

// One part per group.
void main() {
    uint lane = gl_LocalInvocationIndex;
    uint part = GROUP_INDEX;
    uvec2 range = part_range(part, element_count());
    uint sum = sum_before(part, lane);
    for (uint tile = range.x; tile < range.y; tile += TILE) {
        uint first = tile + ITEMS * lane;
        uvec2 scanned[ITEMS];
        uvec2 mine = uvec2(0u);
        for (uint k = 0u; k < ITEMS; ++k) {
            uint i = first + k;
            if (i < range.y) {
                mine = join(mine, uvec2(in_elements[i], min(heads[i], 1u)));
            }
            scanned[k] = mine;
        }
        uvec2 total;
        uvec2 before = join(uvec2(sum, 0u), scan_lanes(mine, lane, total));
        for (uint k = 0u; k < ITEMS; ++k) {
            if (first + k < range.y) {
                out_elements[first + k] = join(before, scanned[k]).x;
            }
        }
        sum = join(uvec2(sum, 0u), total).x;
    }
}
