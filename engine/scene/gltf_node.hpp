#pragma once

#include "scene/gltf_animation.hpp"
#include <vector>

namespace argand {

/// A node of the loaded scene.
struct GltfNode {
    int index;           ///< in the file
    glm::dmat4 to_world; ///< at rest
    bool moves;          ///< the transform changes with time
};

/// All nodes of the loaded scene (the default one, else the first, else all root nodes), parents
/// before children, in the file's order. Adds them to the scene's motion in the same order. Throws
/// Error if a node does not exist or is reached twice (a cycle or two parents).
std::vector<GltfNode> read_nodes(const GltfSource& source, std::vector<NodeKeys> keys,
                                 Scene& scene);

/// Throws Error if the position that a node gives to the object `what` is not finite.
void check_position(const GltfSource& source, const glm::vec3& position, const std::string& what);

} // namespace argand
