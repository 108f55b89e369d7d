#pragma once

#include "base/disjoint_sets.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace argand {

/// The triangles of these materials, by rising index. materials: a flag for each.
std::vector<std::uint32_t> triangles_of(const Scene& scene, const std::vector<bool>& materials);

/// For each triangle of a scene the mesh that moves it; null if it stands still.
std::vector<const MovingMesh*> movers(const Scene& scene);

/// Joins triangles of these that have a corner at the same place: in world space where they stand
/// still, else in the object space of the node or the skin that moves both. So the sets, of indices
/// into `triangles`, do not depend on the moment. mover: see movers().
DisjointSets connected(const Scene& scene, const std::vector<std::uint32_t>& triangles,
                       const std::vector<const MovingMesh*>& mover);

} // namespace argand
