#pragma once

#include "scene/gltf_node.hpp"
#include "scene/gltf_source.hpp"
#include <vector>

namespace argand {

/// Adds the lights of KHR_lights_punctual that nodes carry, in world space (a node's scale does not
/// change a light's intensity). Ignores `range` with a note. Throws Error for lights that do not
/// exist or have a negative intensity.
void add_lights(const GltfSource& source, const std::vector<GltfNode>& nodes, Scene& scene);

} // namespace argand
