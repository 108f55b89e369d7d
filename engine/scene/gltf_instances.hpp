#pragma once

#include "scene/gltf_source.hpp"
#include "scene/motion.hpp"
#include <vector>

namespace argand {

/// Instances that the nodes of a scene may have, about 400 MB. A short file can state many.
inline constexpr std::size_t most_instances = std::size_t(1) << 20;

/// The places in which a node shows its mesh: EXT_mesh_gpu_instancing. Empty if the node lacks the
/// extension, or has no mesh. Takes their number from `instances_left`. Throws Error if the
/// attributes are not as the extension defines them, or if no instances are left.
std::vector<LocalTransform> read_instances(const GltfSource& source, int node,
                                           std::size_t& instances_left, Scene& scene);

} // namespace argand
