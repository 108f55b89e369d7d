#pragma once

#include "scene/gltf_source.hpp"
#include "scene/motion.hpp"
#include <vector>

namespace argand {

/// Reads the animations, lists them in the scene, and returns the keys of each node. Where several
/// animations move one property, the first one does. Throws Error if an animation is malformed.
std::vector<NodeKeys> read_animations(const GltfSource& source, Scene& scene);

} // namespace argand
