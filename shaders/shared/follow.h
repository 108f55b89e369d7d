#ifndef ARGAND_SHARED_FOLLOW_H
#define ARGAND_SHARED_FOLLOW_H

#include "shared/bsdf.h"
#include "shared/path_records.h"

ARGAND_SHARED_BEGIN

// The lobes of a material that are followed from the eye: smooth ones, and glossy ones up to a
// roughness. All others are estimated, from light samples and from photons (docs/design.md: "Which
// path is whose").
FN uint followed_lobes(IN(MaterialRecord) material, real follow_roughness) {
    uint glossy = may_have(material, LOBE_GLOSSY) && material.roughness <= follow_roughness
                      ? LOBE_GLOSSY
                      : 0u;
    return bsdf_lobes(material) & (LOBES_DELTA | glossy);
}

FN uint estimated_lobes(IN(MaterialRecord) material, real follow_roughness) {
    return bsdf_lobes(material) & ~followed_lobes(material, follow_roughness);
}

// Layer of light that reaches the path's next vertex, or the emitter there, straight from a light.
FN uint layer_of_emission(uint state) {
    if ((state & path_estimated) == 0u || (state & path_depth_mask) == 0u) {
        return layer_direct;
    }
    return (state & path_followed) != 0u ? layer_caustic : layer_indirect;
}

// State behind a vertex at which the path was scattered by a followed or an estimated lobe.
FN uint state_after(uint state, bool followed) {
    bool estimated_before = (state & path_estimated) != 0u;
    if (!estimated_before) {
        return followed ? state : path_estimated | path_followed;
    }
    uint next = state + 1u;
    return followed ? next : next & ~path_followed;
}

ARGAND_SHARED_END

#endif
