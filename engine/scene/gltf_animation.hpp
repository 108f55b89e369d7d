#pragma once

#include "scene/gltf_target.hpp"

namespace argand {

/// Reads the animations, lists them in the scene, and returns the keys of each object. Where
/// several animations move one property, the first one does. Notes what pointers of
/// KHR_animation_pointer are not supported. Throws Error if an animation is malformed.
FileKeys read_animations(const GltfSource& source, Scene& scene);

} // namespace argand
