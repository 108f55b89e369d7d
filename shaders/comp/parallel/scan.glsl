// The interface of the kernels scan_parts_*.
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer In { uvec4 in_elements[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer PartSums { uint part_sums[]; };
// One buffer bound twice, to write four elements at a time, or single ones.
layout(set = 0, binding = 3) writeonly buffer Out { uvec4 out_fours[]; };
layout(set = 0, binding = 4) writeonly buffer OutTail { uint out_elements[]; };
layout(push_constant) uniform Push { ScanParams params; };
#include "parallel/parts.glsl"
#include "parallel/sum_before.glsl"

// Sums of the elements before each of four, of which the first has `before`.
uvec4 sums_before_each(uvec4 four, uint before) {
    uvec4 sums;
    sums.x = before;
    sums.y = sums.x + four.x;
    sums.z = sums.y + four.y;
    sums.w = sums.z + four.z;
    return sums;
}
