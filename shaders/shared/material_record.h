#ifndef ARGAND_SHARED_MATERIAL_RECORD_H
#define ARGAND_SHARED_MATERIAL_RECORD_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// A surface in glTF's terms; see Material in engine/scene/scene.hpp. Laid out in 16-byte lanes.
struct MaterialRecord {
    float32 base_r, base_g, base_b, metallic;
    float32 specular_r, specular_g, specular_b, specular;
    float32 emission_r, emission_g, emission_b; // radiance [cd/m²]
    uint double_sided;
    float32 roughness, transmission, ior, thickness;
    float32 coverage; // glTF's alpha: the share of the surface that is present
    // Exponent of modified Phong, whose specular colour is in specular_r, _g, _b; below 0: not
    // Phong.
    float32 exponent;
    // MATERIAL_* and LOBE_* (bsdf.h) that no material of the scene has. 0 in buffers; kernels set
    // it.
    uint absent;
    uint textures; // material_* of texture_record.h; 0: it has none
    float32 absorption_r, absorption_g, absorption_b; // inside a solid [1/length]
    uint unlit; // 1: shows its base colour and scatters nothing
};

ARGAND_SHARED_END

#endif
