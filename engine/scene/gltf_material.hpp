#pragma once

#include "scene/gltf_source.hpp"

namespace argand {

/// Adds the file's materials, in its order. Factors outside their range are brought into it with a
/// note; textures are not read. Error for an index of refraction between 0 and 1.
void add_materials(const GltfSource& source, Scene& scene);

} // namespace argand
