#version 460
layout(local_size_x = 8) in;
#include "kernel.glsl"
#include "parallel/compact.glsl"

// One part per lane; the last lane also knows the total.
void main() {
    if (THREAD_INDEX >= params.parts.parts) {
        return;
    }
    uvec2 range = part_range(THREAD_INDEX, element_count());
    uint to = sum_before(THREAD_INDEX);
    for (uint i = range.x; i < range.y; i += 4u) {
        // A part begins at a multiple of 4, and buffers are padded to 16 bytes.
        uvec4 flagged = first_of(flags[i / 4u], range.y - i, 0u);
        if (any(notEqual(flagged, uvec4(0u)))) {
            to = keep_flagged(flagged, values[i / 4u], to);
        }
    }
    if (THREAD_INDEX == params.parts.parts - 1u) {
        totals[params.total_index] = to;
    }
}
