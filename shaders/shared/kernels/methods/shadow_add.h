#include "shared/kernels/layers.h"
#include "shared/kernels/methods/passed_light.h"

// Adds the radiance that shadow rays bring to the layers of their paths.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[0]) {
        return;
    }
    uint slot = active_slots[i];
    real passed = passed_light(slot);
    if (!(passed > real(0.0))) {
        return;
    }
    ShadowRecord s = shadows[slot];
    add_to_layer(slot, s.layers & 3u, vec3(s.estimated_r, s.estimated_g, s.estimated_b) * passed);
    vec3 followed = vec3(s.followed_r, s.followed_g, s.followed_b) * passed;
    if (followed != vec3(real(0.0))) {
        add_to_layer(slot, s.layers >> 2u, followed);
    }
}
