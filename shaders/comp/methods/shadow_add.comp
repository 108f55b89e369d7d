#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/path_records.h"

layout(set = 0, binding = 0) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer Occluded { uint occluded[]; };
layout(set = 0, binding = 3) readonly buffer Shadows { ShadowRecord shadows[]; };
layout(set = 0, binding = 4) buffer Layers { LayersRecord layers[]; };

#include "layers.glsl"

void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[0]) {
        return;
    }
    uint slot = active_slots[i];
    if (occluded[slot] != 0u) {
        return;
    }
    ShadowRecord s = shadows[slot];
    add_to_layer(slot, s.estimated_layer, vec3(s.estimated_r, s.estimated_g, s.estimated_b));
    vec3 followed = vec3(s.followed_r, s.followed_g, s.followed_b);
    if (followed != vec3(0.0)) {
        add_to_layer(slot, s.followed_layer, followed);
    }
}
