#pragma once

#include "scene/gltf_node.hpp"
#include "scene/gltf_source.hpp"
#include <vector>

namespace argand {

/// Adds the triangles of all meshes that the nodes show, in world space; triangles without area are
/// left out. Scene::materials must have been added: primitives without a material get a default
/// one, appended. Points and lines are ignored with a note. Error for anything out of range and for
/// positions or normals that are not finite.
void add_meshes(const GltfSource& source, const std::vector<GltfNode>& nodes, Scene& scene);

} // namespace argand
