#ifndef ARGAND_SHARED_TEXTURE_RECORD_H
#define ARGAND_SHARED_TEXTURE_RECORD_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// How a material uses an image. Texture coordinates (u, v) become (uu u + uv v + u0,
// vu u + vv v + v0), in which [0,1]² is the image, with its first row at the top.
struct TextureRecord {
    float32 uu, uv, u0, vu;
    float32 vv, v0;
    uint width, height; // at least 1
    uint first;         // index of the first texel
    uint uv_set;        // which of the vertices' texture coordinates
    uint flags;         // texture_*
    float32 scale;      // of a normal texture's slopes; see also texture_of_film_thickness
};

// How coordinates outside [0,1] are treated; the second is shifted by texture_wrap_v.
CONSTANT uint texture_repeat = 0u;
CONSTANT uint texture_mirror = 1u;
CONSTANT uint texture_clamp = 2u;
CONSTANT uint texture_wrap_mask = 3u;
CONSTANT uint texture_wrap_v = 2u;
CONSTANT uint texture_nearest = 16u; // instead of interpolation between four texels
CONSTANT uint texture_srgb = 32u;    // colours are encoded by sRGB's curve
CONSTANT uint texture_mips = 64u;    // its mip levels follow the image, see texel_of_mip()

// What a texture of `material_other_textures` multiplies, in these bits of its flags; they follow
// one another up to one with texture_last.
CONSTANT uint texture_use_shift = 8u;
CONSTANT uint texture_use_mask = 15u;
CONSTANT uint texture_of_specular = 0u;       // by alpha
CONSTANT uint texture_of_specular_color = 1u; // by red, green and blue
CONSTANT uint texture_of_transmission = 2u;   // by red
CONSTANT uint texture_of_thickness = 3u;      // by green
CONSTANT uint texture_of_coat = 4u;           // by red
CONSTANT uint texture_of_coat_roughness = 5u; // by green
CONSTANT uint texture_of_film = 6u;           // by red
// From a share `scale` of the film's thickness to all of it, by green.
CONSTANT uint texture_of_film_thickness = 7u;
CONSTANT uint texture_of_sheen_color = 8u;     // by red, green and blue
CONSTANT uint texture_of_sheen_roughness = 9u; // by alpha
// The direction by red and green (codes 0 to 255 are -1 to 1), the strength by blue.
CONSTANT uint texture_of_anisotropy = 10u;
CONSTANT uint texture_of_coat_normal = 11u; // a normal texture of the coat alone
CONSTANT uint texture_last = 4096u;
CONSTANT uint most_other_textures = 12u;

// Words before the first texel: the linear values of the 256 codes of sRGB, as bits of floats.
CONSTANT uint srgb_codes = 256u;

// Words between those and the first texel: the trees of triangles that shine by their texels
// (texel_tree.h). At most:
CONSTANT uint most_texel_tree_words = 262144u;

// MaterialRecord::textures: the index of the first of the material's textures, which follow one
// another in the order of these bits, and the bits of those that it has.
CONSTANT uint material_texture_mask = 0x00ffffffu;
CONSTANT uint material_base_color_texture = 0x01000000u;
CONSTANT uint material_metal_texture = 0x02000000u; // roughness in green, metallic in blue
CONSTANT uint material_emissive_texture = 0x04000000u;
CONSTANT uint material_normal_texture = 0x08000000u;
CONSTANT uint material_other_textures = 0x10000000u; // one or more, see texture_use_shift
// Some texel may have an estimated lobe: photons are stored on all of the surface, as area samples
// lie on all of it. Those that only surround a texel would make the others dark.
CONSTANT uint material_stores_everywhere = 0x20000000u;
// Alpha of texels and vertices counts: it scales the coverage, or where it is less than the
// material's coverage, the surface is absent.
CONSTANT uint material_alpha_blend = 0x40000000u;
CONSTANT uint material_alpha_mask = 0x80000000u;

ARGAND_SHARED_END

#endif
