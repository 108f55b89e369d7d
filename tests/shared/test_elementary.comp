#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/elementary.h"

layout(set = 0, binding = 0) readonly buffer Inputs { vec2 inputs[]; };
layout(set = 0, binding = 1) writeonly buffer Outputs { float outputs[]; };

void main() {
    uint i = THREAD_INDEX;
    if (i >= uint(inputs.length())) {
        return;
    }
    float x = inputs[i].x;
    float y = inputs[i].y;
    float s, c;
    sincos_2pi(x, s, c);
    outputs[3u * i] = s;
    outputs[3u * i + 1u] = c;
    outputs[3u * i + 2u] = pow_real(abs(x), y);
}
