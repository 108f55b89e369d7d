// Body of scan_parts_subgroup and scan_parts_shared.
#include "parallel/group_scan.glsl"
layout(local_size_x = GROUP_SIZE) in;
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer In { uvec4 in_elements[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer PartSums { uint part_sums[]; };
layout(set = 0, binding = 3) writeonly buffer Out { uvec4 out_fours[]; };
layout(set = 0, binding = 4) writeonly buffer OutTail { uint out_elements[]; };
layout(push_constant) uniform Push { ScanParams params; };
#include "parallel/parts.glsl"
#include "parallel/sum_before.glsl"

// One part per group.
void main() {
    uint lane = scan_order();
    uint part = GROUP_INDEX;
    uvec2 range = part_range(part, element_count());
    uint sum = sum_before(part, lane);
    for (uint tile = range.x; tile < range.y; tile += 4u * GROUP_SIZE) {
        uint i = tile + 4u * lane;
        uint here = min(range.y - min(i, range.y), 4u);
        // Buffers are padded to 16 bytes, so that the last four can be read.
        uvec4 four = here > 0u ? in_elements[i / 4u] : uvec4(0u);
        four = mix(uvec4(0u), four, lessThan(uvec4(0u, 1u, 2u, 3u), uvec4(here)));
        uint total;
        uvec4 before;
        before.x = sum + group_exclusive_sum(four.x + four.y + four.z + four.w, total);
        before.y = before.x + four.x;
        before.z = before.y + four.y;
        before.w = before.z + four.z;
        before += params.inclusive != 0u ? four : uvec4(0u);
        if (here == 4u) {
            out_fours[i / 4u] = before;
        } else {
            for (uint k = 0u; k < here; ++k) {
                out_elements[i + k] = before[k];
            }
        }
        sum += total;
    }
}
