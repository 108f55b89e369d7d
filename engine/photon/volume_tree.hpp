#pragma once

#include "shared/accel_records.h"
#include "shared/geometry_records.h"

#include <cstdint>
#include <span>
#include <vector>

namespace argand {

/// A node over boxes first..first + count - 1 of VolumeTree::order.
struct VolumeNode {
    std::uint32_t first = 0, count = 0;
    std::uint32_t left = 0, right = 0; ///< indices of the children; 0: a leaf
    BoxRecord box{};
};

/// A binary tree over boxes, in host memory.
struct VolumeTree {
    std::vector<std::uint32_t> order; ///< indices of the boxes
    std::vector<VolumeNode> nodes;    ///< the root first, every node before its children
};

/// Builds the tree of the voxel volume heuristic, whose leaves have at most leaf_size boxes (at
/// least 1). Planes sweep through the boxes' centres along each axis, and each node takes the
/// partition of least V_L N_L + V_R N_R (Fabianowski and Dingliana 2009, §5.1, eq. 14). On one
/// thread; O(n log n) if few boxes have the same centre.
VolumeTree build_volume_tree(std::span<const BoxRecord> boxes, std::uint32_t leaf_size);

/// A tree in the layout of LbvhNode, inner node i at 2 i, leaf i at 2 i + 1.
struct LaidOutTree {
    std::vector<LbvhNode> nodes;
    std::vector<std::uint32_t>
        leaves; ///< first box and count of each as in shared/photon_records.h
};

/// Lays the tree out, with its largest subtrees of at most leaf_size boxes as leaves. leaf_size:
/// from the one that the tree was built with to most_photons_a_leaf.
LaidOutTree lay_out(const VolumeTree& tree, std::uint32_t leaf_size);

} // namespace argand
