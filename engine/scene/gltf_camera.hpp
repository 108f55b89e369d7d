#pragma once

#include "scene/gltf_node.hpp"
#include "scene/gltf_source.hpp"
#include <vector>

namespace argand {

/// Adds the cameras that nodes carry, in world space. A node's scale and shear do not affect its
/// camera. `keys`: of each camera of the file. Throws Error for cameras that do not exist or whose
/// angle or extent is not positive.
void add_cameras(const GltfSource& source, const std::vector<GltfNode>& nodes,
                 std::vector<CameraKeys> keys, Scene& scene);

} // namespace argand
