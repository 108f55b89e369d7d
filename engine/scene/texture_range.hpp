#pragma once

#include "scene/material_record.hpp"

#include <cstdint>
#include <vector>

namespace argand {

/// The material as it is where its textures, and the alpha of its vertices, have their least and
/// largest values. Together these have all lobes that it has anywhere. It alone if it has no
/// texture.
std::vector<Material> at_extreme_texels(const Scene& scene, const Material& material);

/// All lobes that `lobes_of` finds in the records of at_extreme_texels().
template <class F>
std::uint32_t lobes_anywhere(const Scene& scene, const Material& material, const F& lobes_of) {
    std::uint32_t lobes = 0;
    for (const Material& variant : at_extreme_texels(scene, material)) {
        lobes |= lobes_of(material_record(variant));
    }
    return lobes;
}

} // namespace argand
