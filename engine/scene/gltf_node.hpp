#pragma once

#include "scene/gltf_animation.hpp"
#include <string>
#include <vector>

namespace argand {

/// A node of the loaded scene.
struct GltfNode {
    int index;           ///< in the file
    glm::dmat4 to_world; ///< at rest
    bool moves;          ///< the transform changes with time
    /// Its mesh is shown by instances, nodes of the same index that show nothing else
    /// (EXT_mesh_gpu_instancing), and not by itself.
    bool is_instanced = false, is_instance = false;
};

/// All nodes of the loaded scene, parents before children, in the file's order, with instances
/// behind theirs. Adds them to the scene's motion in the same order. choice: name or index of a
/// scene of the file; empty: the default one, else the first, else all root nodes. Throws Error if
/// there is no such scene, or a node does not exist or is reached twice (a cycle or two parents).
std::vector<GltfNode> read_nodes(const GltfSource& source, const std::string& choice,
                                 std::vector<NodeKeys> keys, Scene& scene);

/// Throws Error if the position that a node gives to the object `what` is not finite.
void check_position(const GltfSource& source, const glm::vec3& position, const std::string& what);

} // namespace argand
