#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "codes_functions.h"

layout(set = 0, binding = 0) readonly buffer Inputs { Arguments inputs[]; };
layout(set = 0, binding = 1) writeonly buffer Outputs { Values outputs[]; };
layout(set = 0, binding = 2) readonly buffer Which { uint which[]; };

void main() {
    uint i = THREAD_INDEX;
    if (i < uint(inputs.length())) {
        outputs[i] = evaluate_codes(which[0], inputs[i]);
    }
}
