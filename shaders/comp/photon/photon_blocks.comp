#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/geometry_records.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) writeonly buffer Sorted { PhotonRecord sorted[]; };
layout(set = 0, binding = 4) writeonly buffer Boxes { BoxRecord boxes[]; };

// Photons in the order of their codes, and the boxes of blocks of them: the leaves of the map.
void main() {
    uint block = THREAD_INDEX;
    if (block >= counters[counter_blocks]) {
        return;
    }
    uint end = min((block + 1u) * photons_per_block, counters[counter_stored]);
    vec3 low = vec3(3.0e38);
    vec3 high = vec3(-3.0e38);
    for (uint i = block * photons_per_block; i < end; ++i) {
        PhotonRecord p = photons[order[i]];
        sorted[i] = p;
        low = min(low, vec3(p.x, p.y, p.z));
        high = max(high, vec3(p.x, p.y, p.z));
    }
    boxes[block] = BoxRecord(low.x, low.y, low.z, 0.0, high.x, high.y, high.z, 0.0);
}
