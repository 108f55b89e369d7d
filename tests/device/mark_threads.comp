#version 460
layout(local_size_x = 8) in;
#include "kernel.glsl"

layout(set = 0, binding = 0) buffer Visits { uint visits[]; };

// Counts how often each index is visited; the buffer is as long as the indices that count.
void main() {
    if (THREAD_INDEX < visits.length()) {
        visits[THREAD_INDEX] += 1u;
    }
}
