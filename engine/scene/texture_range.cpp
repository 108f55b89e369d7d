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
    for (std::uint32_t i = 0; i < material.texture_count; ++i) {
        const Texture& texture = scene.textures[material.first_texture + i];
        const TextureImage& image = *scene.images[texture.image];
        const auto texel = [&image](bool high) {
            return glm::vec4(high ? image.high : image.low) / 255.0f;
        };
        switch (texture.use) {
        case TextureUse::specular:
            vary([&](Material& m, bool high) { m.specular *= texel(high).a; });
            break;
        case TextureUse::specular_color: // linear or not, as 0 and 1 are the same
            vary([&](Material& m, bool high) { m.specular_color *= glm::vec3(texel(high)); });
            break;
        case TextureUse::transmission:
            vary([&](Material& m, bool high) { m.transmission *= texel(high).r; });
            break;
        case TextureUse::thickness:
            vary([&](Material& m, bool high) { m.thickness *= texel(high).g; });
            break;
        case TextureUse::coat:
            vary([&](Material& m, bool high) { m.coat *= texel(high).r; });
            break;
        case TextureUse::coat_roughness:
            vary([&](Material& m, bool high) { m.coat_roughness *= texel(high).g; });
            break;
        case TextureUse::sheen_color:
            vary([&](Material& m, bool high) { m.sheen_color *= glm::vec3(texel(high)); });
            break;
        case TextureUse::anisotropy:
            vary([&](Material& m, bool high) { m.anisotropy *= texel(high).b; });
            break;
        case TextureUse::film:
            vary([&](Material& m, bool high) { m.film *= texel(high).r; });
            break;
        default:
            break;
        }
    }
    if (material.alpha_varies) {
        // Somewhere between: neither absent nor opaque.
        vary([](Material& m, bool high) { m.coverage *= high ? 1.0f : 0.5f; });
    }
    for (Material& variant : variants) {
        variant.texture_bits = 0;
        variant.first_texture = 0;
        variant.texture_count = 0;
        variant.alpha_varies = false;
    }
    return variants;
}

} // namespace argand
