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
    outputs[9u * i] = s;
    outputs[9u * i + 1u] = c;
    sincos_real(x, s, c);
    outputs[9u * i + 2u] = s;
    outputs[9u * i + 3u] = c;
    outputs[9u * i + 4u] = acos_real(x);
    outputs[9u * i + 5u] = atan2_real(y, x);
    outputs[9u * i + 6u] = exp_real(y);
    outputs[9u * i + 7u] = log_real(abs(x));
    outputs[9u * i + 8u] = pow_real(abs(x), y);
}
