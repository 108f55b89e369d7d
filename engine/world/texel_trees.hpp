#pragma once

#include "scene/scene.hpp"
#include "shared/emissive_records.h"
#include "shared/texture_record.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace argand {

/// The triangles that may shine by an emissive texture.
struct TexelTrees {
    std::vector<std::uint32_t> triangles; ///< by rising index
    std::vector<TexelMean> means;         ///< of each
};

/// White and without a tree if the triangle has no emissive texture.
TexelMean mean_of(const TexelTrees& trees, std::uint32_t triangle);

/// Finds by which texels triangles shine, and appends their trees (shared/texel_tree.h) to `words`.
/// A cell of a tree is chosen in proportion to its area and to its brightest texel, so that no
/// point is much brighter than its density, and each that shines has one. Cells are halved, those
/// first in which the brightest and the darkest texel differ most, until a hundredth of the points
/// is chosen in vain or the words are used up. images, records: of the scene's images and textures.
TexelTrees make_texel_trees(const Scene& scene,
                            const std::vector<std::shared_ptr<const TextureImage>>& images,
                            const std::vector<TextureRecord>& records,
                            std::vector<std::uint32_t>& words);

} // namespace argand
