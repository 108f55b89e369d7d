#pragma once

#include "scene/gltf_animation.hpp"
#include <vector>

namespace argand {

/// A node of the loaded scene with its transform to world space.
struct GltfNode {
    int index;
    glm::dmat4 to_world;
};

/// All nodes of the loaded scene (the default one, else the first, else all root nodes), parents
/// before children, in the file's order. With `seconds` they are posed as the keys of each node say
/// for that time, else as they rest. Throws Error if a node does not exist or is reached twice
/// (a cycle or two parents).
std::vector<GltfNode> flatten_nodes(const GltfSource& source, const std::vector<NodeKeys>& keys,
                                    std::optional<double> seconds);

/// Position that a node's transform gives to the object `what`. Throws Error if it is not finite.
glm::vec3 position_of(const GltfSource& source, const glm::dmat4& to_world,
                      const std::string& what);

} // namespace argand
