#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "accel/count.glsl"
#include "shared/accel_records.h"
#include "shared/morton.h"

layout(set = 0, binding = 0) readonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) writeonly buffer Distances { uint distances[]; };
layout(push_constant) uniform Push { AccelParams params; };

layout(constant_id = 0) const bool wide = false;    // codes of 64 bits

uvec2 code(uint i) { return wide ? uvec2(codes[2u * i], codes[2u * i + 1u]) : uvec2(0u, codes[i]); }

// How far each of the sorted codes is from the next one.
void main() {
    uint i = THREAD_INDEX;
    uint count = ELEMENT_COUNT;
    if (i < count) {
        distances[i] = i + 1u < count ? code_distance(code(i), i, code(i + 1u), i + 1u) : no_neighbour;
    }
}
