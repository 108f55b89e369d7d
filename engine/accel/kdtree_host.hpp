#pragma once

#include "shared/geometry_records.h"
#include "shared/kdtree.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace argand {

struct KdTreeSettings {
    /// Elements are points (the lower corners of their boxes), and are parted by the voxel-volume
    /// heuristic. Else they are boxes, parted by the surface-area heuristic as long as it pays.
    bool points = false;
    float reach = 0;              ///< radius of searches for points, in units of the scene
    std::uint32_t leaf_size = 1;  ///< nodes of at most so many elements are leaves
    std::uint32_t most_depth = 0; ///< planes above a leaf; 0: by the number of elements
    /// Bytes of the tree: words, addresses and boxes. Nodes that would need more stay leaves.
    std::uint64_t memory = std::numeric_limits<std::uint64_t>::max();
};

/// The rules of these settings for so many elements.
KdRules kd_rules(const KdTreeSettings& settings, std::size_t elements);

/// Bytes of a tree with so many leaves, and so many elements in them.
std::uint64_t kd_tree_bytes(std::uint64_t leaves, std::uint64_t elements);

/// Whether a tree so large may be written.
bool kd_tree_fits(std::uint64_t leaves, std::uint64_t elements, const KdTreeSettings& settings);

/// A kd-tree in host memory. See shared/kdtree.h for the words, and the indices of nodes.
struct HostKdTree {
    std::vector<std::uint32_t> words;
    std::vector<std::uint32_t> addresses; ///< of each node the place of its first word
    std::vector<BoxRecord> boxes;         ///< of each node its cell, not the box of its elements
    std::uint32_t leaf_count = 0;         ///< at least 1
    bool stopped = false;                 ///< settings.memory kept nodes from being split
};

/// Builds the tree on one thread, by the rules of the build on the device, whose result it equals
/// word for word. The root's cell holds all elements, and `cell` if there is one.
/// Throws Error if settings.memory does not hold one leaf.
HostKdTree build_kdtree_on_host(std::span<const BoxRecord> boxes, const KdTreeSettings& settings,
                                const BoxRecord* cell = nullptr);

/// The leaf in whose cell a point lies (its index). Points beyond the root's cell are in a leaf,
/// too.
std::uint32_t leaf_of_point(const HostKdTree& tree, const glm::vec3& p);

} // namespace argand
