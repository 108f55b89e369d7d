#version 460
layout(local_size_x = 1) in;
#include "kernel.glsl"
#include "shared/photon_records.h"

layout(set = 0, binding = 0) buffer Counters { uint counters[]; };
layout(push_constant) uniform Push { PhotonAdvanceParams params; };

// Between two bounces: the slots that the last one used are taken, and its survivors are the next one's photons.
void main() {
    if (params.stored != 0u) {
        counters[counter_stored_slots] = min(counters[counter_stored_slots] + counters[counter_active], params.capacity);
    }
    counters[counter_active] = counters[counter_next_active];
}
