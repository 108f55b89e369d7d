#pragma once

#include "scene/gltf_source.hpp"

namespace argand {

/// Adds the file's materials in their order. Clamps factors to their ranges with a note; does not
/// read textures. Throws Error for an index of refraction that is neither 0 nor at least 1.
void add_materials(const GltfSource& source, Scene& scene);

} // namespace argand
