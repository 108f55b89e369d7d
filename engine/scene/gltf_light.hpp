#pragma once

#include "scene/gltf_node.hpp"
#include "scene/gltf_source.hpp"
#include <vector>

namespace argand {

/// The number of lights of KHR_lights_punctual.
std::size_t light_count(const GltfSource& source);

/// A light of KHR_lights_punctual; null if it does not exist.
const nlohmann::json* find_light(const GltfSource& source, std::size_t index);

/// Adds the lights that nodes carry, in world space (a node's scale does not change a light's
/// intensity). `keys`: of each light of the file. Ignores `range` with a note. Throws Error for
/// lights that do not exist or have a negative intensity.
void add_lights(const GltfSource& source, const std::vector<GltfNode>& nodes,
                std::vector<LightKeys> keys, Scene& scene);

} // namespace argand
