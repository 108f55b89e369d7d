#pragma once

#include "photon/cell_tree.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace argand {

/// The planes of the kd-tree of a scene's triangles that do not move, for divide_cells(), with
/// about as many leaves as there may be cells, if it has so many. On one thread.
std::vector<CellNode> triangle_planes(const Scene& scene, double cells);

} // namespace argand
