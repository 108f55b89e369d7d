#pragma once

#include "shared/queue_records.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace argand {

/// A tree of planes that divides space into cells, in pre-order, and the levels at which cells that
/// lie side by side are parted.
struct CellTree {
    std::vector<CellNode> nodes; ///< at least one leaf
    std::uint32_t cells = 1;
    /// Of each cell but the last: the level (from 0 at the root) of the node that parts it from the
    /// next cell.
    std::vector<std::uint32_t> levels;
};

/// The cell that a point lies in.
std::uint32_t cell_of(const CellTree& tree, const glm::vec3& point);

/// Divides the leaves of `planes` (CellNode, as in CellTree; empty: one leaf, which is all of
/// space) on until they hold at most `leaf_size` of the points, each `weight` times: in the middle
/// of the points' longest extent, so that the empty space around them costs nothing (Shi 2012,
/// §3.3, divides no further than triangles do). least: cells there are at least, 1 or 2. The tree
/// has at most most_cell_levels levels.
CellTree divide_cells(std::span<const CellNode> planes, std::vector<glm::vec3> points,
                      double weight, double leaf_size, std::uint32_t least);

} // namespace argand
