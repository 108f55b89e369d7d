#include "photon/photon_kdtree.hpp"

#include "photon/box_around.hpp"

#include <algorithm>

namespace argand {

namespace {

/// Converts a kd-tree from the root down.
class KdTreeConversion {
public:
    KdTreeConversion(const HostKdTree& tree, std::uint32_t leaf_size)
        : words_(tree.words), leaf_size_(leaf_size), counts_(tree.boxes.size()) {
        // Children lie behind their parents.
        std::vector<std::uint32_t> addresses = tree.addresses;
        std::ranges::sort(addresses, std::greater());
        for (const std::uint32_t address : addresses) {
            count(address) = kd_is_leaf(words_[address])
                                 ? words_[address + 1]
                                 : count(kd_left_child(address)) + count(right(address));
        }
    }

    VolumeTree convert() {
        if (count(0) == 0) {
            return {};
        }
        tree_.nodes.emplace_back();
        waiting_.push_back({.node = 0, .address = 0, .first = 0, .count = 0});
        while (!waiting_.empty()) {
            const Visit visit = waiting_.back();
            waiting_.pop_back();
            if (visit.count > 0) {
                divide(visit);
            } else {
                descend(visit);
            }
        }
        return std::move(tree_);
    }

private:
    /// A node of the result, and what it is made of: the node at `address`, or if count is not 0
    /// so many elements of a leaf from word `first` on.
    struct Visit {
        std::uint32_t node, address, first, count;
    };

    std::uint32_t right(std::uint32_t address) const { return kd_right_child(words_[address + 1]); }
    std::uint32_t& count(std::uint32_t address) { return counts_[kd_node_index(words_[address])]; }

    void descend(Visit visit) {
        std::uint32_t at = visit.address;
        while (!kd_is_leaf(words_[at])) {
            const std::uint32_t left_child = kd_left_child(at);
            if (count(left_child) > 0 && count(right(at)) > 0) {
                make_parent(visit.node, count(at),
                            {.node = 0, .address = left_child, .first = 0, .count = 0},
                            {.node = 0, .address = right(at), .first = 0, .count = 0});
                return;
            }
            at = count(left_child) > 0 ? left_child : right(at);
        }
        divide({.node = visit.node,
                .address = at,
                .first = at + kd_leaf_words,
                .count = words_[at + 1]});
    }

    void divide(const Visit& visit) {
        if (visit.count > leaf_size_) {
            const std::uint32_t half = visit.count / 2;
            make_parent(visit.node, visit.count,
                        {.node = 0, .address = 0, .first = visit.first, .count = half},
                        {.node = 0,
                         .address = 0,
                         .first = visit.first + half,
                         .count = visit.count - half});
            return;
        }
        VolumeNode& leaf = tree_.nodes[visit.node];
        leaf.first = static_cast<std::uint32_t>(tree_.order.size());
        leaf.count = visit.count;
        const auto begin = words_.begin() + visit.first;
        tree_.order.insert(tree_.order.end(), begin, begin + visit.count);
    }

    /// The left child is visited next, so that a node's elements lie side by side.
    void make_parent(std::uint32_t node, std::uint32_t elements, Visit left_child,
                     Visit right_child) {
        const auto first_child = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.nodes[node] = {.first = static_cast<std::uint32_t>(tree_.order.size()),
                             .count = elements,
                             .left = first_child,
                             .right = first_child + 1};
        tree_.nodes.resize(tree_.nodes.size() + 2);
        left_child.node = first_child;
        right_child.node = first_child + 1;
        waiting_.push_back(right_child);
        waiting_.push_back(left_child);
    }

    const std::vector<std::uint32_t>& words_;
    std::uint32_t leaf_size_;
    std::vector<std::uint32_t> counts_; ///< elements below each node, by its index
    std::vector<Visit> waiting_;
    VolumeTree tree_;
};

} // namespace

VolumeTree volume_tree_of(const HostKdTree& tree, std::span<const BoxRecord> boxes,
                          std::uint32_t leaf_size) {
    VolumeTree result = KdTreeConversion(tree, leaf_size).convert();
    for (std::size_t i = result.nodes.size(); i-- > 0;) {
        VolumeNode& node = result.nodes[i];
        if (node.left != 0) {
            node.box = box_around(result.nodes[node.left].box, result.nodes[node.right].box);
            continue;
        }
        node.box = boxes[result.order[node.first]];
        for (std::uint32_t k = 1; k < node.count; ++k) {
            node.box = box_around(node.box, boxes[result.order[node.first + k]]);
        }
    }
    return result;
}

VolumeTree build_photon_kdtree(Device& device, std::span<const BoxRecord> boxes, float reach,
                               std::uint32_t leaf_size) {
    std::vector<BoxRecord> centres;
    centres.reserve(boxes.size());
    for (const BoxRecord& b : boxes) {
        const float x = 0.5f * (b.low_x + b.high_x);
        const float y = 0.5f * (b.low_y + b.high_y);
        const float z = 0.5f * (b.low_z + b.high_z);
        centres.push_back({x, y, z, 0, x, y, z, 0});
    }
    const KdTree tree = build_kdtree(device, upload(device, "centres of boxes", centres),
                                     static_cast<std::uint32_t>(centres.size()),
                                     {.points = true, .reach = reach, .leaf_size = leaf_size});
    return volume_tree_of(download_kdtree(device, tree), boxes, leaf_size);
}

} // namespace argand
