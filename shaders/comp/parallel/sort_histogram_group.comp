#version 460
layout(local_size_x = 128) in;
#include "kernel.glsl"
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) writeonly buffer Histograms { uint histograms[]; };
layout(push_constant) uniform Push { SortParams params; };
#include "parallel/parts.glsl"

shared uint digits[sort_digits];

// Counts how often each digit occurs in each part, by digit, then by part. One part per group.
void main() {
    uint lane = gl_LocalInvocationIndex;
    uint part = GROUP_INDEX;
    uvec2 range = part_range(part, element_count());
    for (uint digit = lane; digit < sort_digits; digit += gl_WorkGroupSize.x) {
        digits[digit] = 0u;
    }
    barrier();
    for (uint i = range.x + lane; i < range.y; i += gl_WorkGroupSize.x) {
        uint word = keys[i * params.key_words + params.word];
        atomicAdd(digits[(word >> params.shift) & params.digit_mask], 1u);
    }
    barrier();
    if (part < params.parts.parts) {
        for (uint digit = lane; digit < sort_digits; digit += gl_WorkGroupSize.x) {
            histograms[digit * params.parts.parts + part] = digits[digit];
        }
    }
}
