#ifndef ARGAND_SHARED_MATERIAL_RECORD_H
#define ARGAND_SHARED_MATERIAL_RECORD_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// A surface in glTF's terms; see Material in engine/scene/scene.hpp. Lanes of 16 bytes.
struct MaterialRecord {
    float32 base_r, base_g, base_b, metallic;
    float32 specular_r, specular_g, specular_b, specular;
    float32 emission_r, emission_g, emission_b; // radiance [cd/m²]
    uint double_sided;
    float32 roughness, transmission, ior, thickness;
    float32 coverage; // glTF's alpha: the share of the surface that is there
    float32 exponent; // of modified Phong, whose specular colour is in specular_r, _g, _b; below 0:
                      // not Phong
    uint absent; // MATERIAL_* and LOBE_* (bsdf.h) that no material of the scene has: kernels set
                 // it, 0 in buffers
    uint pad;
};

ARGAND_SHARED_END

#endif
