#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 1) buffer Counters { uint counters[]; };

layout(constant_id = 0) const bool wide = false;    // codes of 64 bits

// No photon's high word is so large.
bool is_empty(uint i) { return codes[wide ? 2u * i + 1u : i] == no_photon; }

// The sorted codes end in those of empty slots; whoever stands at the border knows the number of photons.
void main() {
    uint i = THREAD_INDEX;
    uint slots = counters[counter_stored_slots];
    if (i >= slots || is_empty(i)) {
        return;
    }
    if (i + 1u == slots || is_empty(i + 1u)) {
        counters[counter_stored] = i + 1u;
    }
}
