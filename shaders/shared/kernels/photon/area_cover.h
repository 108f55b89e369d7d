#include "shared/kernels/material.h"

// Takes the area from those sides of area samples on which another surface lies. Glass and what is
// partly absent let light through; where a mask takes a surface away, rays do not hit it.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count || hits[i].triangle == no_triangle) {
        return;
    }
    MaterialRecord material = load_material(triangles[hits[i].triangle].w);
    bool passes = (bsdf_lobes(material) & (LOBE_TRANSMIT | LOBE_CLEAR)) != 0u;
    if (may_have(material, MATERIAL_ALPHA) && (material.textures & material_alpha_mask) == 0u) {
        passes = passes || material.coverage < float32(1.0) ||
                 (material.textures & material_alpha_blend) != 0u;
    }
    if (passes) {
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
