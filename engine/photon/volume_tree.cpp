#include "photon/volume_tree.hpp"

#include "shared/photon_records.h"

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <numeric>

namespace argand {

namespace {

struct Box {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};

    void add(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    double volume() const {
        const glm::dvec3 size(glm::dvec3(high) - glm::dvec3(low));
        return size.x * size.y * size.z;
    }
};

struct Partition {
    double cost = std::numeric_limits<double>::infinity();
    int axis = 0;
    std::uint32_t left = 0; ///< boxes on the left side
};

/// State of the build. A node's boxes are the same range in each of the orders.
struct Builder {
    std::vector<Box> boxes;
    std::array<std::vector<std::uint32_t>, 3>
        orders; ///< by the centres' coordinate along each axis
    std::vector<double> right_volumes;
    std::vector<std::uint32_t> moved;
    std::vector<char> on_left;

    explicit Builder(std::span<const BoxRecord> records)
        : right_volumes(records.size()), moved(records.size()), on_left(records.size()) {
        boxes.reserve(records.size());
        for (const BoxRecord& r : records) {
            boxes.push_back({{r.low_x, r.low_y, r.low_z}, {r.high_x, r.high_y, r.high_z}});
        }
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<std::uint32_t>& order = orders[static_cast<std::size_t>(axis)];
            order.resize(boxes.size());
            std::iota(order.begin(), order.end(), 0u);
            std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
                return boxes[a].low[axis] + boxes[a].high[axis] <
                       boxes[b].low[axis] + boxes[b].high[axis];
            });
        }
    }

    Box bounds(const VolumeNode& node) const {
        Box box;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            box.add(boxes[orders[0][i]]);
        }
        return box;
    }

    Partition best_partition(const VolumeNode& node) {
        Partition best;
        const auto off_middle = [&](std::uint32_t left) {
            return std::max(left, node.count - left);
        };
        for (int axis = 0; axis < 3; ++axis) {
            const std::uint32_t* order = orders[static_cast<std::size_t>(axis)].data() + node.first;
            Box right;
            for (std::uint32_t i = node.count - 1; i > 0; --i) {
                right.add(boxes[order[i]]);
                right_volumes[i] = right.volume();
            }
            Box left;
            for (std::uint32_t i = 1; i < node.count; ++i) {
                left.add(boxes[order[i - 1]]);
                const double cost = left.volume() * i + right_volumes[i] * (node.count - i);
                // All partitions of boxes at one place cost the same. Halving them keeps the tree
                // shallow.
                if (cost < best.cost ||
                    (cost == best.cost && off_middle(i) < off_middle(best.left))) {
                    best = {cost, axis, i};
                }
            }
        }
        return best;
    }

    void apply(const VolumeNode& node, const Partition& partition) {
        const auto first = static_cast<std::ptrdiff_t>(node.first);
        const auto chosen = orders[static_cast<std::size_t>(partition.axis)].begin() + first;
        for (std::uint32_t i = 0; i < node.count; ++i) {
            on_left[chosen[i]] = i < partition.left ? 1 : 0;
        }
        for (std::vector<std::uint32_t>& order : orders) {
            const auto begin = order.begin() + first;
            auto kept = begin;
            auto aside = moved.begin();
            for (auto i = begin; i != begin + node.count; ++i) {
                (on_left[*i] != 0 ? *kept++ : *aside++) = *i;
            }
            std::copy(moved.begin(), aside, kept);
        }
    }
};

BoxRecord record(const Box& box) {
    return {box.low.x, box.low.y, box.low.z, 0, box.high.x, box.high.y, box.high.z, 0};
}

} // namespace

VolumeTree build_volume_tree(std::span<const BoxRecord> boxes, std::uint32_t leaf_size) {
    VolumeTree tree;
    if (boxes.empty()) {
        return tree;
    }
    Builder builder(boxes);
    tree.nodes.push_back({.first = 0, .count = static_cast<std::uint32_t>(boxes.size())});
    // Children are appended, so that the loop reaches them.
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const VolumeNode node = tree.nodes[i];
        tree.nodes[i].box = record(builder.bounds(node));
        if (node.count <= leaf_size) {
            continue;
        }
        const Partition partition = builder.best_partition(node);
        builder.apply(node, partition);
        tree.nodes[i].left = static_cast<std::uint32_t>(tree.nodes.size());
        tree.nodes[i].right = tree.nodes[i].left + 1;
        tree.nodes.push_back({.first = node.first, .count = partition.left});
        tree.nodes.push_back(
            {.first = node.first + partition.left, .count = node.count - partition.left});
    }
    tree.order = std::move(builder.orders[0]);
    return tree;
}

LaidOutTree lay_out(const VolumeTree& tree, std::uint32_t leaf_size) {
    LaidOutTree result;
    if (tree.nodes.empty()) {
        return result;
    }
    const auto is_leaf = [&](const VolumeNode& node) {
        return node.count <= leaf_size || node.left == 0;
    };
    std::vector<std::uint32_t> leaf_counts(tree.nodes.size(), 1);
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        const VolumeNode& node = tree.nodes[i];
        if (!is_leaf(node)) {
            leaf_counts[i] = leaf_counts[node.left] + leaf_counts[node.right];
        }
    }
    result.nodes.resize(2 * std::size_t(leaf_counts[0]));
    result.leaves.resize(leaf_counts[0]);

    struct Visit {
        std::uint32_t node;
        std::uint32_t first_leaf;
        std::uint32_t place;
        std::uint32_t escape;
    };
    const auto place_of = [&](std::uint32_t node, std::uint32_t first_leaf, bool is_left) {
        const std::uint32_t count = leaf_counts[node];
        return count == 1 ? 2 * first_leaf + 1
                          : 2 * (is_left ? first_leaf + count - 1 : first_leaf);
    };
    std::vector<Visit> waiting{{0, 0, leaf_counts[0] == 1 ? 1u : 0u, lbvh_end}};
    while (!waiting.empty()) {
        const Visit visit = waiting.back();
        waiting.pop_back();
        const VolumeNode& node = tree.nodes[visit.node];
        const BoxRecord& b = node.box;
        std::uint32_t child = 0;
        if (leaf_counts[visit.node] == 1) {
            child = node.first | (node.count - 1) << leaf_first_bits;
            result.leaves[visit.first_leaf] = child;
        } else {
            const std::uint32_t right_leaf = visit.first_leaf + leaf_counts[node.left];
            const std::uint32_t right = place_of(node.right, right_leaf, false);
            child = place_of(node.left, visit.first_leaf, true);
            waiting.push_back({node.left, visit.first_leaf, child, right});
            waiting.push_back({node.right, right_leaf, right, visit.escape});
        }
        result.nodes[visit.place] = {b.low_x,  b.low_y,  b.low_z,  child,
                                     b.high_x, b.high_y, b.high_z, visit.escape};
    }
    return result;
}

} // namespace argand
