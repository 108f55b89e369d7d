#version 460
layout(local_size_x = 8) in;
#include "kernel.glsl"

layout(set = 0, binding = 0) buffer Visits { uint visits[]; };

// Counts the visits to each index of the buffer; ignores indices beyond its end.
void main() {
    if (THREAD_INDEX < visits.length()) {
        visits[THREAD_INDEX] += 1u;
    }
}
