#pragma once

#include "scene/gltf_node.hpp"
#include "scene/gltf_source.hpp"
#include <vector>

namespace argand {

/// Adds the triangles of all meshes that nodes show, in world space; leaves out triangles without
/// area. Scene::materials must be complete: primitives without a material get a default one,
/// appended to it. Ignores points and lines with a note. Throws Error for indices out of range and
/// for positions or normals that are not finite.
void add_meshes(const GltfSource& source, const std::vector<GltfNode>& nodes, Scene& scene);

} // namespace argand
