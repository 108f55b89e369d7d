#version 460
layout(local_size_x = 128) in;
#include "kernel.glsl"
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer In { uvec4 in_elements[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) writeonly buffer Out { uint results[]; };
layout(push_constant) uniform Push { ReduceParams params; };
#include "parallel/parts.glsl"

shared uint values[gl_WorkGroupSize.x];

uint combine(uint a, uint b) {
    return params.op == reduce_op_min ? min(a, b) : params.op == reduce_op_max ? max(a, b) : a + b;
}

// Writes one result per part. One part per group.
void main() {
    uint lane = gl_LocalInvocationIndex;
    uint identity = params.op == reduce_op_min ? 0xffffffffu : 0u;
    uvec2 range = part_range(GROUP_INDEX, element_count());
    uint value = identity;
    // Parts begin at multiples of 4, and buffers are padded to 16 bytes.
    for (uint i = range.x + 4u * lane; i < range.y; i += 4u * gl_WorkGroupSize.x) {
        uvec4 four = in_elements[i / 4u];
        if (params.op == reduce_op_count) {
            four = uvec4(notEqual(four, uvec4(0u)));
        }
        if (range.y - i < 4u) {
            four = first_of(four, range.y - i, identity);
        }
        value = combine(value, combine(combine(four.x, four.y), combine(four.z, four.w)));
    }
    values[lane] = value;
    for (uint width = gl_WorkGroupSize.x / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width) {
            values[lane] = combine(values[lane], values[lane + width]);
        }
    }
    if (lane == 0u && GROUP_INDEX < params.parts.parts) {
        results[params.first_out + GROUP_INDEX] = values[0];
    }
}
