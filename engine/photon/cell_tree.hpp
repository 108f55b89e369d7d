#pragma once

#include "shared/geometry_records.h"
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

/// The box of each cell, half open, which reaches as far as there are numbers where no plane ends
/// it.
std::vector<BoxRecord> cell_extents(const CellTree& tree);

/// The planes of a kd-tree (accel/kdtree_host.hpp), without its elements.
std::vector<CellNode> planes_of(std::span<const std::uint32_t> kd_tree_words);

/// Divides space until cells hold at most `leaf_size` of the points, each of which counts as often
/// as its fourth component says: first by `planes` (CellNode, as in CellTree; none: nothing is
/// divided by them), then in the middle of the longest extent of the points in a cell, so that no
/// cell is a long list (Shi 2012, §3.3, divides as far as triangles are divided, and no further).
/// least: cells there are at least, 1 or 2. The tree has at most most_cell_levels levels.
CellTree divide_cells(std::span<const CellNode> planes, std::vector<glm::vec4> points,
                      double leaf_size, std::uint32_t least);

} // namespace argand
