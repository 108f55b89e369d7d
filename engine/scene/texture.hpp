#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace argand {

/// The decoded pixels of an image file, row by row from the top: red in the lowest byte of each
/// word, then green, blue and alpha.
struct TextureImage {
    std::string name; ///< for messages
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint32_t> texels;
    glm::u8vec4 low{255}, high{0}; ///< least and largest value of each channel
};

/// How texture coordinates outside [0,1] are treated.
enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

/// What texels multiply or turn.
enum class TextureUse : std::uint8_t {
    base_color,
    metallic_roughness,
    emissive,
    normal,
    specular,
    specular_color,
    transmission,
    thickness,
    coat,
    coat_roughness,
    coat_normal,
    film,
    film_thickness,
    anisotropy,
    sheen_color,
    sheen_roughness
};

/// How a material uses an image (glTF 2.0, sections 3.8 and 3.9, KHR_texture_transform).
struct Texture {
    std::uint32_t image = 0;  ///< index into Scene::images
    std::uint32_t uv_set = 0; ///< less than Scene::uv_sets
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false;        ///< the nearest texel instead of bilinear interpolation
    bool mips = false;           ///< the sampler filters minified images by mip maps
    bool srgb = false;           ///< colours are encoded; alpha never is
    glm::mat3x2 transform{1.0f}; ///< of texture coordinates (u, v, 1)
    TextureUse use = TextureUse::base_color;
    /// Of the slopes of a normal texture, also the coat's; of a film's thickness: its least over
    /// its greatest.
    float scale = 1;
};

} // namespace argand
