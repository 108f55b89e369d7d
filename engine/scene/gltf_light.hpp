#pragma once

#include "scene/gltf_node.hpp"
#include "scene/gltf_source.hpp"
#include <vector>

namespace argand {

/// Adds the lights of KHR_lights_punctual that the nodes carry, in world space (a node's scale does
/// not change a light's intensity). `range` is ignored with a note. Error for lights that do not
/// exist or that are negative.
void add_lights(const GltfSource& source, const std::vector<GltfNode>& nodes, Scene& scene);

} // namespace argand
