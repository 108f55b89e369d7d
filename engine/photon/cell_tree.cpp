#include "photon/cell_tree.hpp"

#include "shared/kdtree.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace argand {

namespace {

constexpr std::uint32_t no_plane = 0xffffffffu;

struct Split {
    int axis = -1; ///< -1: none
    float at = 0;
};

std::uint32_t axis_of(const CellNode& node) { return node.link >> cell_axis_shift; }

void add_planes(std::span<const std::uint32_t> words, std::uint32_t address,
                std::vector<CellNode>& planes) {
    const std::size_t node = planes.size();
    planes.push_back({cell_is_leaf << cell_axis_shift, 0});
    if (kd_is_leaf(words[address])) {
        return;
    }
    const std::uint32_t parent = words[address + 1];
    planes[node].split = bits_float(words[address + 2]);
    add_planes(words, kd_left_child(address), planes);
    planes[node].link =
        (kd_axis(parent) << cell_axis_shift) | static_cast<std::uint32_t>(planes.size());
    add_planes(words, kd_right_child(parent), planes);
}

/// State of the division. A node's points are a range of `points`.
struct Divider {
    std::span<const CellNode> planes;
    std::vector<glm::vec4> points;
    double leaf_size;
    std::uint32_t least;
    CellTree tree;

    double count(std::size_t first, std::size_t end) const {
        double sum = 0;
        for (std::size_t i = first; i < end; ++i) {
            sum += points[i].w;
        }
        return sum;
    }

    /// The middle of the points' longest extent. None if they are at one place; needed: any plane.
    Split middle_of(std::size_t first, std::size_t end, bool needed) const {
        if (first == end) {
            return needed ? Split{0, 0} : Split{};
        }
        glm::vec3 low = points[first];
        glm::vec3 high = low;
        for (std::size_t i = first; i < end; ++i) {
            low = glm::min(low, glm::vec3(points[i]));
            high = glm::max(high, glm::vec3(points[i]));
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        // A plane through the lowest point would leave its left side empty.
        const float middle = low[axis] + 0.5f * size[axis];
        const float at = middle > low[axis] ? middle : high[axis];
        return at > low[axis] || needed ? Split{axis, at} : Split{};
    }

    void divide(std::size_t first, std::size_t end, std::uint32_t plane, std::uint32_t level) {
        const std::size_t node = tree.nodes.size();
        const bool needed = node + 1 < least;
        Split split;
        std::uint32_t left = no_plane;
        std::uint32_t right = no_plane;
        if (level < most_cell_levels && (needed || count(first, end) > leaf_size)) {
            if (plane != no_plane && axis_of(planes[plane]) != cell_is_leaf) {
                split = {static_cast<int>(axis_of(planes[plane])), planes[plane].split};
                left = plane + 1;
                right = planes[plane].link & cell_link_mask;
            } else {
                split = middle_of(first, end, needed);
            }
        }
        tree.nodes.emplace_back();
        if (split.axis < 0) {
            tree.nodes[node].link = (cell_is_leaf << cell_axis_shift) | tree.cells++;
            return;
        }
        const auto begin = points.begin();
        const auto middle = static_cast<std::size_t>(
            std::partition(begin + static_cast<std::ptrdiff_t>(first),
                           begin + static_cast<std::ptrdiff_t>(end),
                           [&](const glm::vec4& p) { return p[split.axis] < split.at; }) -
            begin);
        tree.nodes[node].split = split.at;
        divide(first, middle, left, level + 1);
        tree.levels.push_back(
            level); // between the last cell on the left and the first on the right
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

std::vector<BoxRecord> cell_extents(const CellTree& tree) {
    constexpr float end = std::numeric_limits<float>::max();
    struct Extent {
        glm::vec3 low{-end}, high{end};
    };
    std::vector<Extent> of_nodes(tree.nodes.size());
    std::vector<BoxRecord> extents(tree.cells);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) { // children lie behind their parents
        const Extent e = of_nodes[i];
        const CellNode& node = tree.nodes[i];
        const std::uint32_t link = node.link & cell_link_mask;
        if (axis_of(node) == cell_is_leaf) {
            extents[link] = {e.low.x, e.low.y, e.low.z, 0, e.high.x, e.high.y, e.high.z, 0};
            continue;
        }
        const int axis = static_cast<int>(axis_of(node));
        of_nodes[i + 1] = of_nodes[link] = e;
        of_nodes[i + 1].high[axis] = std::min(e.high[axis], node.split);
        of_nodes[link].low[axis] = std::max(e.low[axis], node.split);
    }
    return extents;
}

std::vector<CellNode> planes_of(std::span<const std::uint32_t> words) {
    std::vector<CellNode> planes;
    add_planes(words, 0, planes);
    return planes;
}

CellTree divide_cells(std::span<const CellNode> planes, std::vector<glm::vec4> points,
                      double leaf_size, std::uint32_t least) {
    Divider divider{planes, std::move(points), leaf_size, least, {}};
    divider.tree.cells = 0;
    divider.divide(0, divider.points.size(), planes.empty() ? no_plane : 0, 0);
    return std::move(divider.tree);
}

} // namespace argand
