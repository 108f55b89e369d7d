// Body of compact_parts_subgroup and compact_parts_shared.
#include "parallel/group_scan.glsl"
layout(local_size_x = GROUP_SIZE) in;
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer Flags { uvec4 flags[]; };
layout(set = 0, binding = 1) readonly buffer Values { uvec4 values[]; };
layout(set = 0, binding = 2) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 3) readonly buffer PartSums { uint part_sums[]; };
layout(set = 0, binding = 4) writeonly buffer Out { uint kept[]; };
layout(set = 0, binding = 5) writeonly buffer Totals { uint totals[]; };
layout(push_constant) uniform Push { CompactParams params; };
#include "parallel/parts.glsl"
#include "parallel/sum_before.glsl"

// One part per group; the last one also knows the total.
void main() {
    uint lane = scan_order();
    uint part = GROUP_INDEX;
    uvec2 range = part_range(part, element_count());
    uint kept_before = sum_before(part, lane);
    for (uint tile = range.x; tile < range.y; tile += 4u * GROUP_SIZE) {
        uint i = tile + 4u * lane;
        uvec4 keep = uvec4(0u);
        if (i < range.y) {
            keep = uvec4(notEqual(flags[i / 4u], uvec4(0u)));
            keep *= uvec4(lessThan(uvec4(0u, 1u, 2u, 3u), uvec4(range.y - i)));
        }
        uint total;
        uint mine = keep.x + keep.y + keep.z + keep.w;
        uint to = kept_before + group_exclusive_sum(mine, total);
        if (mine > 0u) {
            uvec4 four = values[i / 4u];
            for (uint k = 0u; k < 4u; ++k) {
                if (keep[k] != 0u) {
                    kept[to] = four[k];
                    ++to;
                }
            }
        }
        kept_before += total;
    }
    if (lane == 0u && part == params.parts.parts - 1u) {
        totals[params.total_index] = kept_before;
    }
}
