#include "shared/kernels/methods/passed_light.h"

// Keys by which splats are sorted: their place, or params.none, which is behind all places, if
// something blocks their shadow ray.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counters[counter_active]) {
        return;
    }
    uint slot = active_slots[i];
    bool passes = passed_light(slot) > real(0.0);
    keys[i] = passes ? min(splats[slot].place, params.none) : params.none;
    slots[i] = slot;
}
