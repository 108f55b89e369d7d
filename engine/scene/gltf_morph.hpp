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

/// Vectors that the morph targets of a scene may have, about 400 MB. A short file can state many.
inline constexpr std::size_t most_morph_vectors = std::size_t(1) << 25;
/// Morph weights that the nodes of a scene may have.
inline constexpr std::size_t most_morph_weights = std::size_t(1) << 22;

/// What each morph target of a primitive adds to these vertices; takes their number from
/// `vectors_left`. Throws Error if a target has not as many vertices as the primitive, or one that
/// is not finite, or if no vectors are left.
std::vector<MorphTarget> read_morph_targets(const GltfSource& source,
                                            const tinygltf::Primitive& primitive,
                                            const Surface& surface,
                                            const std::vector<std::size_t>& vertices,
                                            const std::string& name, std::size_t& vectors_left);

} // namespace argand
