#pragma once

#include "scene/gltf_node.hpp"
#include "scene/gltf_source.hpp"
#include <map>
#include <string>
#include <vector>

namespace argand {

/// The skins of a file; reads those that are used, once each.
class Skins {
public:
    /// Keeps references.
    Skins(const GltfSource& source, const std::vector<GltfNode>& nodes);

    /// Index of the file's skin `skin` in the scene's motion, where it is added if it is new.
    /// Throws Error if it does not exist, or has joints or matrices that do not.
    int number_of(int skin, Scene& scene);

    /// Whether any joint of the skin moves.
    bool moves(int skin) const;

    /// The joints that carry these vertices of a primitive, with weights that sum to 1; adds a note
    /// if the file's are off by more than 1 %. Of more than four joints the heaviest four count,
    /// with a note. Throws Error for joints that do not exist, and for weights that are negative,
    /// not finite, or all 0.
    std::vector<JointWeights> weights_of(int skin, const tinygltf::Primitive& primitive,
                                         const std::vector<std::size_t>& vertices,
                                         const std::string& name, Scene& scene) const;

private:
    const GltfSource& source_;
    const std::vector<GltfNode>& nodes_;
    std::vector<int> number_of_node_; ///< in the scene's motion, of each node of the file; -1: none
    std::map<int, int> known_;        ///< skins of the file, and their indices in the motion
};

} // namespace argand
