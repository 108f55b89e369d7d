#version 460
layout(local_size_x = 8) in;
#include "kernel.glsl"
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer In { uvec4 in_elements[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer PartSums { uint part_sums[]; };
layout(set = 0, binding = 3) writeonly buffer Out { uvec4 out_fours[]; };
layout(set = 0, binding = 4) writeonly buffer OutTail { uint out_elements[]; };
layout(push_constant) uniform Push { ScanParams params; };
#include "parallel/parts.glsl"

// One part per lane.
void main() {
    if (THREAD_INDEX >= params.parts.parts) {
        return;
    }
    uvec2 range = part_range(THREAD_INDEX, element_count());
    uint sum = 0u;
    for (uint part = 0u; part < THREAD_INDEX; ++part) {
        sum += part_sums[part];
    }
    for (uint i = range.x / 4u; i < range.y / 4u; ++i) {
        uvec4 four = in_elements[i];
        uvec4 before;
        before.x = sum;
        before.y = before.x + four.x;
        before.z = before.y + four.y;
        before.w = before.z + four.z;
        sum = before.w + four.w;
        out_fours[i] = params.inclusive != 0u ? before + four : before;
    }
    // What follows the last element stays as it is.
    uint tail = range.y & ~3u;
    if (tail >= range.x && tail < range.y) {
        uvec4 four = in_elements[tail / 4u];
        for (uint i = tail; i < range.y; ++i) {
            uint element = four[i - tail];
            out_elements[i] = params.inclusive != 0u ? sum + element : sum;
            sum += element;
        }
    }
}
