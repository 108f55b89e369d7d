#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"

layout(set = 0, binding = 0) readonly buffer From { uint from_values[]; };
layout(set = 0, binding = 1) writeonly buffer To { uint to_values[]; };

// Adds to each value its neighbour, which another invocation of the previous kernel wrote.
void main() {
    uint n = from_values.length();
    if (THREAD_INDEX < n) {
        to_values[THREAD_INDEX] = from_values[THREAD_INDEX] + from_values[(THREAD_INDEX + n - 1u) % n];
    }
}
