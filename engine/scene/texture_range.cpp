#include "scene/texture_range.hpp"

#include "shared/texture_record.h"

#include <array>
#include <cstddef>
#include <utility>

namespace argand {

std::vector<Material> at_extreme_texels(const Scene& scene, const Material& material) {
    std::vector<Material> variants{material};
    const auto vary = [&](const auto& change) {
        std::vector<Material> varied;
        varied.reserve(2 * variants.size());
        for (const Material& variant : variants) {
            for (const bool high : {false, true}) {
                varied.push_back(variant);
                change(varied.back(), high);
            }
        }
        variants = std::move(varied);
    };
    std::size_t next = material.first_texture;
    next += (material.texture_bits & material_base_color_texture) != 0 ? 1 : 0;
    if ((material.texture_bits & material_metal_texture) != 0) {
        const TextureImage& image = *scene.images[scene.textures[next].image];
        const auto range = [&](int channel) {
            return std::array{float(image.low[channel]) / 255, float(image.high[channel]) / 255};
        };
        vary([&](Material& m, bool high) { m.roughness *= range(1)[high ? 1 : 0]; });
        vary([&](Material& m, bool high) { m.metallic *= range(2)[high ? 1 : 0]; });
    }
    if (material.alpha_varies) {
        // Somewhere between: neither absent nor opaque.
        vary([](Material& m, bool high) { m.coverage *= high ? 1.0f : 0.5f; });
    }
    for (Material& variant : variants) {
        variant.texture_bits = 0;
        variant.first_texture = 0;
        variant.alpha_varies = false;
    }
    return variants;
}

} // namespace argand
