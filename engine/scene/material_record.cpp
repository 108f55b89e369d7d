#include "scene/material_record.hpp"

#include "shared/texture_record.h"

namespace argand {

MaterialRecord material_record(const Material& m) {
    MaterialRecord record{m.base_color.r,
                          m.base_color.g,
                          m.base_color.b,
                          m.metallic,
                          m.specular_color.r,
                          m.specular_color.g,
                          m.specular_color.b,
                          m.specular,
                          m.emission.r,
                          m.emission.g,
                          m.emission.b,
                          m.double_sided ? 1u : 0u,
                          m.roughness,
                          m.transmission,
                          m.ior,
                          m.thickness,
                          m.coverage,
                          -1,
                          0,
                          m.texture_bits | m.first_texture,
                          m.absorption.r,
                          m.absorption.g,
                          m.absorption.b,
                          m.unlit ? 1u : 0u,
                          m.coat,
                          m.coat_roughness,
                          m.dispersion,
                          m.film,
                          m.film_ior,
                          m.film_thickness,
                          m.sheen_roughness,
                          m.anisotropy.x,
                          m.sheen_color.r,
                          m.sheen_color.g,
                          m.sheen_color.b,
                          m.anisotropy.y,
                          0,
                          0,
                          m.coat_has_normal ? 1.0f : 0.0f,
                          0}; // solids: World sets them
    if (m.alpha_varies && m.alpha_mode == AlphaMode::blend) {
        record.textures |= material_alpha_blend;
    } else if (m.alpha_varies && m.alpha_mode == AlphaMode::mask && m.coverage > 0) {
        record.textures |= material_alpha_mask;
        record.coverage = m.alpha_threshold;
    }
    if (m.phong) {
        const glm::vec3& specular = m.phong->specular;
        record.metallic = 0;
        record.transmission = 0;
        record.thickness = 0;
        record.coat = 0;
        record.coat_normal_z = 0;
        record.film = 0;
        record.anisotropy_x = record.anisotropy_y = 0;
        record.sheen_r = record.sheen_g = record.sheen_b = 0;
        record.dispersion = 0;
        record.specular_r = specular.r;
        record.specular_g = specular.g;
        record.specular_b = specular.b;
        record.specular = specular == glm::vec3(0) ? 0.0f : 1.0f;
        record.exponent = m.phong->exponent;
        record.roughness = roughness_of_phong(record.exponent);
    }
    return record;
}

} // namespace argand
