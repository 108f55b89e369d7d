#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) buffer Counters { uint counters[]; };

// Counts the slots that hold a photon.
void main() {
    uint first = THREAD_INDEX * slots_per_tally;
    uint end = min(first + slots_per_tally, counters[counter_stored_slots]);
    uint count = 0u;
    for (uint i = first; i < end; ++i) {
        count += photons[i].normal == no_photon ? 0u : 1u;
    }
    if (count > 0u) {
        atomicAdd(counters[counter_photons], count);
    }
}
