#pragma once

#include "scene/gltf_node.hpp"
#include "scene/gltf_source.hpp"
#include <vector>

namespace argand {

/// Adds the cameras that the nodes carry, in world space; a node's scale and shear do not change a
/// camera. Error for cameras that do not exist or whose angle or extent is not positive.
void add_cameras(const GltfSource& source, const std::vector<GltfNode>& nodes, Scene& scene);

} // namespace argand
