#version 460
layout(local_size_x = 8) in;
#include "kernel.glsl"
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer Keys { uvec4 keys[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) writeonly buffer Histograms { uint histograms[]; };
layout(push_constant) uniform Push { SortParams params; };
#include "parallel/parts.glsl"

// Counts how often each digit occurs in each part, by digit, then by part. One part per lane, with
// a private array: the fastest memory of such devices.
void main() {
    uint part = THREAD_INDEX;
    uvec2 range = part_range(part, element_count()) * params.key_words;     // in words
    uint digits[sort_digits];
    for (uint digit = 0u; digit < sort_digits; ++digit) {
        digits[digit] = 0u;
    }
    for (uint i = range.x; i < range.y; i += 4u) {
        // Buffers are padded to 16 bytes, so that the last four can be read.
        uvec4 words = keys[i / 4u];
        uvec4 found = (words >> params.shift) & params.digit_mask;
        if (params.key_words == 1u) {
            ++digits[found.x];
            digits[found.y] += i + 1u < range.y ? 1u : 0u;
            digits[found.z] += i + 2u < range.y ? 1u : 0u;
            digits[found.w] += i + 3u < range.y ? 1u : 0u;
        } else {
            ++digits[params.word == 0u ? found.x : found.y];
            digits[params.word == 0u ? found.z : found.w] += i + 2u < range.y ? 1u : 0u;
        }
    }
    if (part < params.parts.parts) {
        for (uint digit = 0u; digit < sort_digits; ++digit) {
            histograms[digit * params.parts.parts + part] = digits[digit];
        }
    }
}
