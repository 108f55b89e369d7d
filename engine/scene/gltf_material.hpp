#pragma once

#include "scene/gltf_source.hpp"
#include "scene/motion.hpp"
#include <vector>

namespace argand {

/// Adds the file's materials in their order, with what moves of them. `keys`: of each material.
/// Clamps factors to their ranges with a note, and decodes the textures that are read. Throws Error
/// for an index of refraction that is neither 0 nor at least 1, and for a texture that is not
/// valid.
void add_materials(const GltfSource& source, std::vector<MaterialKeys> keys, Scene& scene);

} // namespace argand
