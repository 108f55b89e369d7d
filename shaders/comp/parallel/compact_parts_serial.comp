#version 460
layout(local_size_x = 8) in;
#include "kernel.glsl"
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer Flags { uvec4 flags[]; };
layout(set = 0, binding = 1) readonly buffer Values { uvec4 values[]; };
layout(set = 0, binding = 2) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 3) readonly buffer PartSums { uint part_sums[]; };
layout(set = 0, binding = 4) writeonly buffer Out { uint kept[]; };
layout(set = 0, binding = 5) writeonly buffer Totals { uint totals[]; };
layout(push_constant) uniform Push { CompactParams params; };
#include "parallel/parts.glsl"

// One part per lane; the last one also knows the total.
void main() {
    if (THREAD_INDEX >= params.parts.parts) {
        return;
    }
    uvec2 range = part_range(THREAD_INDEX, element_count());
    uint to = 0u;
    for (uint part = 0u; part < THREAD_INDEX; ++part) {
        to += part_sums[part];
    }
    for (uint i = range.x; i < range.y; i += 4u) {
        uvec4 keep = flags[i / 4u];
        // A part begins at a multiple of 4, and buffers are padded to 16 bytes.
        keep = mix(uvec4(0u), keep, lessThan(uvec4(0u, 1u, 2u, 3u), uvec4(range.y - i)));
        if (any(notEqual(keep, uvec4(0u)))) {
            uvec4 four = values[i / 4u];
            for (uint k = 0u; k < 4u; ++k) {
                if (keep[k] != 0u) {
                    kept[to] = four[k];
                    ++to;
                }
            }
        }
    }
    if (THREAD_INDEX == params.parts.parts - 1u) {
        totals[params.total_index] = to;
    }
}
