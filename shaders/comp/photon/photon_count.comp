#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 1) buffer Counters { uint counters[]; };

// The sorted codes end in those of empty slots; whoever stands at the border knows the number of photons.
void main() {
    uint i = THREAD_INDEX;
    uint slots = counters[counter_stored_slots];
    if (i >= slots || codes[i] == no_photon) {
        return;
    }
    if (i + 1u == slots || codes[i + 1u] == no_photon) {
        counters[counter_stored] = i + 1u;
    }
}
