#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/morton.h"
#include "shared/photon.h"
#include "shared/scene_records.h"

layout(set = 0, binding = 0) readonly buffer SceneBlock { SceneRecord scene[]; };
layout(set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 3) writeonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 4) writeonly buffer Order { uint order[]; };

// Along the space-filling curve, caustic photons behind the others. Empty slots get the largest code and end up behind all.
void main() {
    uint i = THREAD_INDEX;
    if (i >= counters[counter_stored_slots]) {
        return;
    }
    PhotonRecord p = photons[i];
    vec3 center = vec3(scene[0].center_x, scene[0].center_y, scene[0].center_z);
    vec3 low = center - scene[0].radius;
    vec3 high = center + scene[0].radius;
    uint kind = photon_is_caustic(p.normal) ? 1u << photon_kind_shift : 0u;
    codes[i] = p.normal == no_photon ? no_photon : morton30(vec3(p.x, p.y, p.z), low, high) | kind;
    order[i] = i;
}
