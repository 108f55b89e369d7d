#include "shared/kernels/photon/wall.h"

// Takes the coverage from estimates whose photons' flux has its centroid behind something, so that
// estimate_add does not take them, and the eye path goes on. Glass and veils hide as walls do.
FN void main() {
    uint slot;
    vec3 offset;
    if (!find_centroid(slot, offset)) {
        return;
    }
    if (offset != vec3(real(0.0)) && occluded[slot] != 0u) {
        estimates[slot].coverage = real(0.0);
    }
}
