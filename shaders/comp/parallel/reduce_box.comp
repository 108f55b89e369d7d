#version 460
layout(local_size_x = 128) in;
#include "kernel.glsl"
#include "shared/parallel_records.h"

// The low and the high corner of each BoxRecord.
layout(set = 0, binding = 0) readonly buffer In { vec4 corners[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) writeonly buffer Out { vec4 results[]; };
layout(push_constant) uniform Push { ReduceBoxParams params; };
#include "parallel/parts.glsl"

shared vec3 lows[gl_WorkGroupSize.x];
shared vec3 highs[gl_WorkGroupSize.x];

// Writes one box per part. One part per group.
void main() {
    uint lane = gl_LocalInvocationIndex;
    uvec2 range = part_range(GROUP_INDEX, element_count());
    vec3 low = vec3(bits_float(0x7f800000u));       // infinity: an empty box
    vec3 high = -low;
    for (uint i = range.x + lane; i < range.y; i += gl_WorkGroupSize.x) {
        low = min(low, corners[2u * i].xyz);
        high = max(high, corners[2u * i + 1u].xyz);
    }
    lows[lane] = low;
    highs[lane] = high;
    for (uint width = gl_WorkGroupSize.x / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width) {
            lows[lane] = min(lows[lane], lows[lane + width]);
            highs[lane] = max(highs[lane], highs[lane + width]);
        }
    }
    if (lane == 0u && GROUP_INDEX < params.parts.parts) {
        uint out_index = 2u * (params.first_out + GROUP_INDEX);
        results[out_index] = vec4(lows[0], 0.0);
        results[out_index + 1u] = vec4(highs[0], 0.0);
    }
}
