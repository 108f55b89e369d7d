#pragma once

#include "device/device.hpp"
#include "scene/scene.hpp"
#include "world/texel_trees.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace argand {

/// What kernels read of a scene's textures (shaders/comp/texture_bindings.glsl).
struct TextureTable {
    Buffer records; ///< TextureRecord per texture of the scene
    Buffer texels;  ///< uint: linear values of the codes of sRGB, trees, the texels of all images
    std::uint32_t halvings = 0; ///< see FittingImages
    TexelTrees trees;
};

/// Uploads the scene's textures. If they exceed what one buffer may hold, the largest images are
/// halved until they fit.
TextureTable make_texture_table(Device& device, const Scene& scene);

/// The images of a scene, with the largest halved until all together have at most so many texels,
/// or one each.
struct FittingImages {
    std::vector<std::shared_ptr<const TextureImage>> images;
    std::uint32_t halvings = 0; ///< of the sides of the image that was halved most often
};
FittingImages fitting_images(const Scene& scene, std::uint64_t most);

/// Texture coordinates and colours of the vertices: for each vertex uv_sets times two floats, then
/// its colour as four words of 16 bits, if the scene has any. Behind them, two elements for each
/// triangle: the tangents at its corners, if the scene has any, and a word that is not used.
Buffer upload_attributes(Device& device, const Scene& scene);

/// How many a vertex has.
std::uint32_t attributes_of_vertex(const Scene& scene);

/// The element at which the tangents begin.
std::uint32_t first_tangent(const Scene& scene);

/// An image of half the width and height, at least 1. Texels are means of linear values, weighted
/// by alpha if the image has any. srgb: its colours are encoded.
TextureImage halved(const TextureImage& image, bool srgb);

} // namespace argand
