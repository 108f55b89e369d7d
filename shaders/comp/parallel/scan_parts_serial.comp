#version 460
layout(local_size_x = 8) in;
#include "kernel.glsl"
#include "parallel/scan.glsl"

// One part per lane.
void main() {
    if (THREAD_INDEX >= params.parts.parts) {
        return;
    }
    uvec2 range = part_range(THREAD_INDEX, element_count());
    uint sum = sum_before(THREAD_INDEX);
    for (uint i = range.x / 4u; i < range.y / 4u; ++i) {
        uvec4 four = in_elements[i];
        uvec4 before = sums_before_each(four, sum);
        sum = before.w + four.w;
        out_fours[i] = params.inclusive != 0u ? before + four : before;
    }
    // Elements behind the last one stay as they are.
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
