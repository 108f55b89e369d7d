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
    float32 coat, coat_roughness;
    float32 dispersion; // of a solid: 20 over Abbe's number
    // Thin film on metal or dielectric: its share of the surface, index of refraction, thickness
    // [micrometres].
    float32 film, film_ior, film_thickness;
    float32 sheen_roughness;
    // Anisotropy of GGX reflection by metal and dielectric: its strength, times the cosine and the
    // sine of the angle from the tangent to the direction in which facets spread most. Kernels turn
    // it into the shading frame (kernels/anisotropy.h).
    float32 anisotropy_x;
    float32 sheen_r, sheen_g, sheen_b;
    float32 anisotropy_y;
    // Normal of a coat that has one of its own, as the surface's or the coat's is turned by a
    // texture; else (0,0,0). In the frame of the tangents, with z > 0; kernels turn it into the
    // shading frame (kernels/coat.h).
    float32 coat_normal_x, coat_normal_y, coat_normal_z;
    // Low 5 bits: of a solid 1 more than its rank (solids.h); 0: it has none. High bits: a table
    // of its own, whose entry r, in record r, is the index of the material of rank r.
    uint solids;
};

ARGAND_SHARED_END

#endif
