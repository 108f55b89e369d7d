// Body of compact_parts_subgroup and compact_parts_shared.
#include "parallel/group_scan.glsl"
layout(local_size_x = GROUP_SIZE) in;
#include "parallel/compact.glsl"

// One part per group; the last group also knows the total.
void main() {
    uint lane = scan_order();
    uint part = GROUP_INDEX;
    uvec2 range = part_range(part, element_count());
    uint kept_before = sum_before(part, lane);
    for (uint tile = range.x; tile < range.y; tile += 4u * GROUP_SIZE) {
        uint i = tile + 4u * lane;
        uvec4 flagged = uvec4(0u);
        if (i < range.y) {
            flagged = first_of(uvec4(notEqual(flags[i / 4u], uvec4(0u))), range.y - i, 0u);
        }
        uint total;
        uint mine = flagged.x + flagged.y + flagged.z + flagged.w;
        uint to = kept_before + group_exclusive_sum(mine, total);
        if (mine > 0u) {
            keep_flagged(flagged, values[i / 4u], to);
        }
        kept_before += total;
    }
    if (lane == 0u && part == params.parts.parts - 1u) {
        totals[params.total_index] = kept_before;
    }
}
