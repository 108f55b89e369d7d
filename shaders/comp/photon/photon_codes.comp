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

layout(constant_id = 0) const bool wide = false;    // codes of 64 bits, low word first

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
    vec3 position = vec3(p.x, p.y, p.z);
    bool empty = p.normal == no_photon;
    uint kind = photon_is_caustic(p.normal) ? photon_kind_bit : 0u;
    if (wide) {
        uvec2 code = morton63(position, low, high);
        codes[2u * i] = empty ? no_photon : code.x;
        codes[2u * i + 1u] = empty ? no_photon : code.y | kind;
    } else {
        codes[i] = empty ? no_photon : (morton30(position, low, high) << 1u) | kind;
    }
    order[i] = i;
}
