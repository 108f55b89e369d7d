#pragma once

#include "accel/kdtree.hpp"
#include "photon/volume_tree.hpp"

namespace argand {

/// The tree over boxes of which `tree` is the kd-tree of points, one in each box. Empty leaves are
/// left out, and points in one place are halved into leaves of leaf_size (at least 1).
VolumeTree volume_tree_of(const HostKdTree& tree, std::span<const BoxRecord> boxes,
                          std::uint32_t leaf_size);

/// Builds the kd-tree of the boxes' centres on the device, by the voxel-volume heuristic (Zhou et
/// al. 2008), for search within `reach`; leaves have at most leaf_size boxes. The gathers walk it
/// as lay_out() lays it out. Waits for the device.
VolumeTree build_photon_kdtree(Device& device, std::span<const BoxRecord> boxes, float reach,
                               std::uint32_t leaf_size);

} // namespace argand
