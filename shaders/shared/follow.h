#ifndef ARGAND_SHARED_FOLLOW_H
#define ARGAND_SHARED_FOLLOW_H

#include "shared/bsdf.h"
#include "shared/path_records.h"

ARGAND_SHARED_BEGIN

// A path continues through *followed* lobes: smooth ones, rough glass and coats, and glossy ones up
// to the roughness given by --follow-roughness. Light that arrives at any other lobe is
// *estimated*, from light samples and photons. docs/path-classes.md lists which method accounts for
// which paths.
FN uint followed_lobes(IN(MaterialRecord) material, real follow_roughness) {
    uint glossy = may_have(material, LOBE_GLOSSY) && material.roughness <= follow_roughness
                      ? LOBE_GLOSSY
                      : 0u;
    return bsdf_lobes(material) & (LOBES_DELTA | LOBES_SPREAD | glossy);
}

FN uint estimated_lobes(IN(MaterialRecord) material, real follow_roughness) {
    return bsdf_lobes(material) & ~followed_lobes(material, follow_roughness);
}

// Layer to which emission found by the path's current ray, or light sampled at its end, belongs.
FN uint layer_of_emission(uint state) {
    if ((state & path_estimated) == 0u || (state & path_depth_mask) == 0u) {
        return layer_direct;
    }
    return (state & path_followed) != 0u ? layer_caustic : layer_indirect;
}

// State of a path after scattering by a followed or an estimated lobe.
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
