#include "shared/kernels/material.h"

// Takes the area from those sides of area samples on which another surface lies. Glass and what is
// partly transparent lets light through, and so may a surface with a mask: its texels are not read.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count || hits[i].triangle == no_triangle) {
        return;
    }
    MaterialRecord material = load_material(triangles[hits[i].triangle].w);
    if ((bsdf_lobes(material) & (LOBE_TRANSMIT | LOBE_PASS)) != 0u) {
        return;
    }
    uint side = params.first + i;
    uint slot = counters[counter_stored_slots] + side / 2u;
    if (side % 2u == 0u) {
        photons[slot].flux_r = real(0.0);
    } else {
        photons[slot].flux_g = real(0.0);
    }
}
