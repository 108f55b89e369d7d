#pragma once

#include "scene/gltf_surface.hpp"
#include "scene/motion.hpp"
#include <cstddef>
#include <string>
#include <vector>

namespace argand {

/// Number of morph targets of the mesh that a node shows; 0 without one. Throws Error if the mesh's
/// primitives have different numbers.
std::size_t morph_target_count(const GltfSource& source, int node);

/// The weights of a node's morph targets at rest: the node's, else the mesh's, else 0. Throws Error
/// if there are not as many as targets, or they are not finite.
std::vector<double> rest_weights(const GltfSource& source, int node);

/// What each morph target of a primitive adds to these vertices. Throws Error if a target has not
/// as many vertices as the primitive, or one that is not finite.
std::vector<MorphTarget> read_morph_targets(const GltfSource& source,
                                            const tinygltf::Primitive& primitive,
                                            const Surface& surface,
                                            const std::vector<std::size_t>& vertices,
                                            const std::string& name);

} // namespace argand
