#include "photon/cell_tree.hpp"

#include <algorithm>
#include <cmath>

namespace argand {

namespace {

constexpr std::uint32_t no_plane = 0xffffffffu;

struct Split {
    int axis = -1; ///< -1: none
    float at = 0;
};

std::uint32_t axis_of(const CellNode& node) { return node.link >> cell_axis_shift; }

/// State of the division. A node's points are a range of `points`.
struct Divider {
    std::span<const CellNode> planes;
    std::vector<glm::vec3> points;
    double weight, leaf_size;
    std::uint32_t least;
    CellTree tree;

    /// The middle of the points' longest extent. None if they are few or at one place.
    Split split_of(std::size_t first, std::size_t end) const {
        const bool too_few_cells = tree.nodes.size() + 1 < least;
        if (!too_few_cells && static_cast<double>(end - first) * weight <= leaf_size) {
            return {};
        }
        if (first == end) {
            return too_few_cells ? Split{0, 0} : Split{};
        }
        glm::vec3 low = points[first];
        glm::vec3 high = low;
        for (std::size_t i = first; i < end; ++i) {
            low = glm::min(low, points[i]);
            high = glm::max(high, points[i]);
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        // A split at the lowest point would leave its left side empty.
        const float middle = low[axis] + 0.5f * size[axis];
        const float at = middle > low[axis] ? middle : high[axis];
        return at > low[axis] || too_few_cells ? Split{axis, at} : Split{};
    }

    void divide(std::size_t first, std::size_t end, std::uint32_t plane, std::uint32_t level) {
        const std::size_t node = tree.nodes.size();
        Split split;
        std::uint32_t left = no_plane;
        std::uint32_t right = no_plane;
        if (plane != no_plane && axis_of(planes[plane]) != cell_is_leaf) {
            split = {static_cast<int>(axis_of(planes[plane])), planes[plane].split};
            left = plane + 1;
            right = planes[plane].link & cell_link_mask;
        } else {
            split = split_of(first, end);
        }
        tree.nodes.emplace_back();
        if (split.axis < 0 || level >= most_cell_levels) {
            tree.nodes[node].link = (cell_is_leaf << cell_axis_shift) | tree.cells++;
            return;
        }
        const auto begin = points.begin();
        const auto middle = static_cast<std::size_t>(
            std::partition(begin + static_cast<std::ptrdiff_t>(first),
                           begin + static_cast<std::ptrdiff_t>(end),
                           [&](const glm::vec3& p) { return p[split.axis] < split.at; }) -
            begin);
        tree.nodes[node].split = split.at;
        divide(first, middle, left, level + 1);
        tree.levels.push_back(level); // between the last cell on the left and the first on the right
        tree.nodes[node].link = (static_cast<std::uint32_t>(split.axis) << cell_axis_shift) |
                                static_cast<std::uint32_t>(tree.nodes.size());
        divide(middle, end, right, level + 1);
    }
};

} // namespace

std::uint32_t cell_of(const CellTree& tree, const glm::vec3& point) {
    std::uint32_t node = 0;
    while (axis_of(tree.nodes[node]) != cell_is_leaf) {
        const CellNode& n = tree.nodes[node];
        node = point[static_cast<int>(axis_of(n))] < n.split ? node + 1 : n.link & cell_link_mask;
    }
    return tree.nodes[node].link & cell_link_mask;
}

CellTree divide_cells(std::span<const CellNode> planes, std::vector<glm::vec3> points,
                      double weight, double leaf_size, std::uint32_t least) {
    Divider divider{planes, std::move(points), weight, leaf_size, least, {}};
    divider.tree.cells = 0;
    divider.divide(0, divider.points.size(), planes.empty() ? no_plane : 0, 0);
    return std::move(divider.tree);
}

} // namespace argand
