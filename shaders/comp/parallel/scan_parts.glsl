// Body of scan_parts_subgroup and scan_parts_shared.
#include "parallel/group_scan.glsl"
layout(local_size_x = GROUP_SIZE) in;
#include "parallel/scan.glsl"

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
        four = first_of(four, here, 0u);
        uint total;
        uint lanes_before = group_exclusive_sum(four.x + four.y + four.z + four.w, total);
        uvec4 before = sums_before_each(four, sum + lanes_before);
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
