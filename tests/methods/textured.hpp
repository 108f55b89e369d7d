#pragma once

#include "scene/scene.hpp"
#include "scenes.hpp"
#include "shared/texture_record.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace argand::testing {

inline std::uint32_t texel(int red, int green, int blue, int alpha = 255) {
    return std::bit_cast<std::uint32_t>(glm::u8vec4(red, green, blue, alpha));
}

/// Gives a material a texture of these texels, row by row. Call in the order of the material's
/// bits.
inline void add_texture(Scene& scene, std::uint32_t material, std::uint32_t bit,
                        std::uint32_t width, std::vector<std::uint32_t> texels, bool nearest) {
    TextureImage image{.name = "image",
                       .width = width,
                       .height = static_cast<std::uint32_t>(texels.size()) / width,
                       .texels = std::move(texels)};
    for (const std::uint32_t t : image.texels) {
        image.low = glm::min(image.low, std::bit_cast<glm::u8vec4>(t));
        image.high = glm::max(image.high, std::bit_cast<glm::u8vec4>(t));
    }
    Material& of = scene.materials[material];
    if (of.texture_bits == 0) {
        of.first_texture = static_cast<std::uint32_t>(scene.textures.size());
    }
    of.texture_bits |= bit;
    ++of.texture_count;
    scene.textures.push_back(
        {.image = static_cast<std::uint32_t>(scene.images.size()),
         .nearest = nearest,
         .srgb = bit == material_base_color_texture || bit == material_emissive_texture,
         .use = bit == material_normal_texture ? TextureUse::normal : TextureUse::base_color});
    of.alpha_varies = of.alpha_varies || (of.alpha_mode != AlphaMode::opaque && image.low.a < 255);
    scene.images.push_back(std::make_shared<const TextureImage>(std::move(image)));
    scene.uv_sets = 1;
}

/// Adds 4 x 4 squares of edges a and b, of which every other one is there: each a quad, or one quad
/// with a texture whose alpha cuts them out.
inline void add_checker(Scene& scene, Material of, glm::vec3 corner, glm::vec3 a, glm::vec3 b,
                        bool by_alpha) {
    of.alpha_mode = AlphaMode::mask;
    of.alpha_threshold = 0.5f;
    const std::uint32_t material = add_material(scene, of);
    std::vector<std::uint32_t> texels;
    for (int i = 0; i < 16; ++i) {
        const bool there = (i + i / 4) % 2 == 0;
        texels.push_back(texel(255, 255, 255, there ? 200 : 100));
        if (!by_alpha && there) {
            add_quad(scene, corner + float(i % 4) * a + float(i / 4) * b, a, b, material);
        }
    }
    if (by_alpha) {
        add_quad(scene, corner, 4.0f * a, 4.0f * b, material);
        add_texture(scene, material, material_base_color_texture, 4, std::move(texels), true);
    }
}

/// Gives all vertices as texture coordinates their place in the plane y = 0, so that the image lies
/// in 0 <= x, z <= size.
inline void project(Scene& scene, float size) {
    for (const glm::vec3& p : scene.positions) {
        scene.uvs.emplace_back(p.x / size, p.z / size);
    }
}

/// Gives all vertices texture coordinates that are regular on surfaces of any direction but one.
inline void project_obliquely(Scene& scene) {
    for (const glm::vec3& p : scene.positions) {
        scene.uvs.emplace_back(0.7f * p.x + 0.3f * p.y, 0.7f * p.z - 0.4f * p.y);
    }
}

/// sRGB's curve, IEC 61966-2-1.
inline double linear(int code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

} // namespace argand::testing
