#pragma once

#include "scene/gltf_source.hpp"
#include "scene/key_frames.hpp"
#include <optional>
#include <vector>

namespace argand {

/// The properties of a node that an animation moves.
struct NodeKeys {
    std::optional<KeyFrames> translation, rotation, scale;
};

/// Reads the animations, lists them in the scene, and returns the keys of each node. Where several
/// animations move one property, the first one does. Throws Error if an animation is malformed.
std::vector<NodeKeys> read_animations(const GltfSource& source, Scene& scene);

} // namespace argand
