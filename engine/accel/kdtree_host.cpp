#include "accel/kdtree_host.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace argand {

namespace {

constexpr std::uint32_t no_axis = 3;

struct Cell {
    vec3 low{}, high{};
};

Cell united(const Cell& a, const Cell& b) { return {min(a.low, b.low), max(a.high, b.high)}; }

struct Node {
    Cell cell;
    KdPlane plane{no_axis, 0};
    std::uint32_t left = 0; ///< index of the left child, before the right one
    std::uint32_t depth = 0;
    std::vector<std::uint32_t> elements; ///< of a leaf
};

struct Counts {
    std::uint32_t left = 0, right = 0;
};

/// State of a build. All nodes of a level are split before those of the next, so that the memory
/// ends the build at the same place as on the device.
class Builder {
public:
    Builder(std::span<const BoxRecord> boxes, const KdTreeSettings& settings, const BoxRecord* cell)
        : settings_(settings), rules_(kd_rules(settings, boxes.size())) {
        boxes_.reserve(boxes.size());
        for (const BoxRecord& box : boxes) {
            boxes_.push_back(cell_of(box));
        }
        Node root;
        root.elements.resize(boxes.size());
        std::iota(root.elements.begin(), root.elements.end(), 0u);
        root.cell = boxes_.empty() ? Cell{} : box_of(root);
        if (cell != nullptr) {
            const Cell outer = cell_of(*cell);
            root.cell = boxes_.empty() ? outer : united(root.cell, outer);
        }
        root.cell.high = kd_just_above(root.cell.high);
        references_ = boxes.size();
        nodes_.push_back(std::move(root));
    }

    HostKdTree build() {
        if (!kd_tree_fits(leaves_, references_, settings_)) {
            fail(
                "building a kd-tree: its memory of {} bytes does not hold one leaf of {} elements, "
                "which takes {}; allow more (--tree-memory)",
                settings_.memory, references_, kd_tree_bytes(leaves_, references_));
        }
        std::vector<std::uint32_t> large, small;
        (is_small(nodes_[0]) ? small : large).push_back(0);
        while (!large.empty()) {
            const std::vector<KdPlane> planes = planes_of(large, &Builder::plane_of_large);
            std::vector<std::uint32_t> next;
            for (const std::uint32_t child : split(large, planes)) {
                (is_small(nodes_[child]) ? small : next).push_back(child);
            }
            large = std::move(next);
        }
        while (!small.empty()) {
            small = split(small, planes_of(small, &Builder::plane_of_small));
        }
        return written();
    }

private:
    Cell cell_of(const BoxRecord& box) const {
        const vec3 low = kd_position({box.low_x, box.low_y, box.low_z});
        const vec3 high = kd_position({box.high_x, box.high_y, box.high_z});
        return {low, settings_.points ? low : max(low, high)};
    }

    static bool is_small(const Node& node) { return node.elements.size() <= kd_small; }

    bool is_done(const Node& node) const {
        return node.elements.size() <= rules_.leaf_size || node.depth >= rules_.most_depth;
    }

    Cell box_of(const Node& node) const {
        Cell box = boxes_[node.elements[0]];
        for (const std::uint32_t element : node.elements) {
            box = united(box, boxes_[element]);
        }
        return box;
    }

    bool is_left(std::uint32_t element, const KdPlane& plane) const {
        return kd_is_left(kd_at(boxes_[element].low, plane.axis), plane.split);
    }
    bool is_right(std::uint32_t element, const KdPlane& plane) const {
        return kd_is_right(kd_at(boxes_[element].high, plane.axis), plane.split);
    }

    Counts count(const Node& node, const KdPlane& plane) const {
        Counts counts;
        for (const std::uint32_t element : node.elements) {
            counts.left += is_left(element, plane) ? 1 : 0;
            counts.right += is_right(element, plane) ? 1 : 0;
        }
        return counts;
    }

    KdPlane plane_of_large(const Node& node) const {
        if (is_done(node)) {
            return {no_axis, 0};
        }
        const auto& [low, high] = node.cell;
        const Cell box = box_of(node);
        const KdPlane cut = kd_cut(low, high, max(box.low, low), min(box.high, high));
        if (cut.axis != no_axis) {
            return cut;
        }
        const KdSpace space = kd_space(low, high, rules_);
        const auto elements = static_cast<std::uint32_t>(node.elements.size());
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t axis = kd_longest(high - low, k);
            const KdPlane plane{axis, kd_middle(kd_at(low, axis), kd_at(high, axis))};
            const auto [lefts, rights] = count(node, plane);
            if (kd_is_candidate(space, plane, lefts, rights, rules_) &&
                kd_plane_cost(space, plane, lefts, rights, rules_) <
                    kd_cost_to_beat(space, elements, rules_)) {
                return plane;
            }
        }
        return {no_axis, 0};
    }

    KdPlane plane_of_small(const Node& node) const {
        KdPlane best{no_axis, 0};
        if (is_done(node)) {
            return best;
        }
        const KdSpace space = kd_space(node.cell.low, node.cell.high, rules_);
        real least =
            kd_cost_to_beat(space, static_cast<std::uint32_t>(node.elements.size()), rules_);
        const auto consider = [&](const KdPlane& plane) {
            const auto [lefts, rights] = count(node, plane);
            if (kd_is_candidate(space, plane, lefts, rights, rules_)) {
                const real cost = kd_plane_cost(space, plane, lefts, rights, rules_);
                if (cost < least) {
                    least = cost;
                    best = plane;
                }
            }
        };
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            for (const std::uint32_t element : node.elements) {
                consider({axis, kd_at(boxes_[element].low, axis)});
                if (!settings_.points) {
                    consider({axis, kd_above(kd_at(boxes_[element].high, axis))});
                }
            }
        }
        return best;
    }

    /// The planes of a level's nodes, or none at all if the tree would become too large.
    std::vector<KdPlane> planes_of(const std::vector<std::uint32_t>& level,
                                   KdPlane (Builder::*plane_of)(const Node&) const) {
        std::vector<KdPlane> planes;
        planes.reserve(level.size());
        std::uint64_t leaves = leaves_;
        std::uint64_t references = references_;
        for (const std::uint32_t i : level) {
            planes.push_back((this->*plane_of)(nodes_[i]));
            if (planes.back().axis != no_axis) {
                const auto [lefts, rights] = count(nodes_[i], planes.back());
                leaves += 1;
                references += lefts + rights - nodes_[i].elements.size();
            }
        }
        if (leaves > leaves_ && !kd_tree_fits(leaves, references, settings_)) {
            stopped_ = true;
            return std::vector<KdPlane>(level.size(), KdPlane{no_axis, 0});
        }
        leaves_ = leaves;
        references_ = references;
        return planes;
    }

    /// Splits nodes by their planes. Returns the children.
    std::vector<std::uint32_t> split(const std::vector<std::uint32_t>& level,
                                     const std::vector<KdPlane>& planes) {
        std::vector<std::uint32_t> children;
        children.reserve(2 * level.size());
        for (std::size_t i = 0; i < level.size(); ++i) {
            const KdPlane& plane = planes[i];
            if (plane.axis == no_axis) {
                continue;
            }
            const auto left_child = static_cast<std::uint32_t>(nodes_.size());
            Node& node = nodes_[level[i]];
            node.plane = plane;
            node.left = left_child;
            Node left, right;
            left.depth = right.depth = node.depth + 1;
            left.cell = right.cell = node.cell;
            left.cell.high = kd_with(left.cell.high, plane.axis, plane.split);
            right.cell.low = kd_with(right.cell.low, plane.axis, plane.split);
            std::ranges::copy_if(node.elements, std::back_inserter(left.elements),
                                 [&](std::uint32_t e) { return is_left(e, plane); });
            std::ranges::copy_if(node.elements, std::back_inserter(right.elements),
                                 [&](std::uint32_t e) { return is_right(e, plane); });
            node.elements = {};
            children.insert(children.end(), {left_child, left_child + 1});
            nodes_.push_back(std::move(left));
            nodes_.push_back(std::move(right));
        }
        return children;
    }

    HostKdTree written() const {
        HostKdTree tree;
        tree.stopped = stopped_;
        tree.leaf_count = static_cast<std::uint32_t>(leaves_);
        tree.words.reserve(kd_parent_words * (leaves_ - 1) + kd_leaf_words * leaves_ + references_);
        tree.addresses.resize(2 * leaves_ - 1);
        tree.boxes.resize(2 * leaves_ - 1);
        struct Visit {
            std::uint32_t node;
            std::size_t
                parent; ///< whose right child the node is: place of the word with its address
        };
        constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
        std::uint32_t leaf = 0;
        std::uint32_t parent = tree.leaf_count;
        std::vector<Visit> waiting{{0, none}};
        while (!waiting.empty()) {
            const Visit visit = waiting.back();
            waiting.pop_back();
            const Node& node = nodes_[visit.node];
            const auto address = static_cast<std::uint32_t>(tree.words.size());
            if (visit.parent != none) {
                tree.words[visit.parent] |= address;
            }
            const bool is_leaf = node.plane.axis == no_axis;
            const std::uint32_t index = is_leaf ? leaf++ : parent++;
            tree.addresses[index] = address;
            const auto& [low, high] = node.cell;
            tree.boxes[index] = {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
            if (is_leaf) {
                tree.words.push_back(index | kd_leaf);
                tree.words.push_back(static_cast<std::uint32_t>(node.elements.size()));
                tree.words.insert(tree.words.end(), node.elements.begin(), node.elements.end());
            } else {
                tree.words.insert(tree.words.end(), {index, kd_parent_word(node.plane.axis, 0),
                                                     float_bits(node.plane.split)});
                waiting.push_back({node.left + 1, address + std::size_t(1)});
                waiting.push_back({node.left, none});
            }
        }
        return tree;
    }

    KdTreeSettings settings_;
    KdRules rules_;
    std::vector<Cell> boxes_;
    std::vector<Node> nodes_;
    // Of the tree as it would be if no further node were split.
    std::uint64_t leaves_ = 1;
    std::uint64_t references_ = 0;
    bool stopped_ = false;
};

} // namespace

KdRules kd_rules(const KdTreeSettings& settings, std::size_t elements) {
    // Boxes that overlap cannot be parted. About 1.3 log2 n planes are known to do for triangles
    // (Pharr, Jakob and Humphreys, "Physically Based Rendering", section 4.4.2); cutting off empty
    // space takes some more.
    const auto usual = 12 + 3 * static_cast<std::uint32_t>(std::bit_width(elements)) / 2;
    const std::uint32_t wanted = settings.most_depth > 0 ? settings.most_depth
                                 : settings.points       ? kd_most_depth
                                                         : usual;
    return {.points = settings.points ? 1u : 0u,
            .reach = kd_flushed(std::clamp(settings.reach, 0.0f, 1e37f)),
            .leaf_size = std::max(settings.leaf_size, 1u),
            .most_depth = std::min(wanted, kd_most_depth)};
}

std::uint64_t kd_tree_bytes(std::uint64_t leaves, std::uint64_t elements) {
    const std::uint64_t words = kd_parent_words * (leaves - 1) + kd_leaf_words * leaves + elements;
    return 4 * words + (2 * leaves - 1) * (4 + sizeof(BoxRecord));
}

bool kd_tree_fits(std::uint64_t leaves, std::uint64_t elements, const KdTreeSettings& settings) {
    const std::uint64_t words = kd_parent_words * (leaves - 1) + kd_leaf_words * leaves + elements;
    return words <= kd_most_words && kd_tree_bytes(leaves, elements) <= settings.memory;
}

HostKdTree build_kdtree_on_host(std::span<const BoxRecord> boxes, const KdTreeSettings& settings,
                                const BoxRecord* cell) {
    return Builder(boxes, settings, cell).build();
}

std::uint32_t leaf_of_point(const HostKdTree& tree, const glm::vec3& p) {
    const glm::vec3 position = kd_position(p);
    std::uint32_t address = 0;
    while (!kd_is_leaf(tree.words[address])) {
        const std::uint32_t parent = tree.words[address + 1];
        const float split = bits_float(tree.words[address + 2]);
        address = kd_is_left(kd_at(position, kd_axis(parent)), split) ? kd_left_child(address)
                                                                      : kd_right_child(parent);
    }
    return kd_node_index(tree.words[address]);
}

} // namespace argand
