#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "footprint_case.h"

layout(set = 0, binding = 0) readonly buffer Lights { LightRecord lights[]; };
layout(set = 0, binding = 1) writeonly buffer Results { FootprintResult results[]; };

void main() {
    uint i = THREAD_INDEX;
    if (i >= uint(results.length())) {
        return;
    }
    results[i] = footprint_case(lights[i], i);
}
