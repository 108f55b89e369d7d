#pragma once

#include "accel/kdtree_host.hpp"
#include "device/device.hpp"

namespace argand {

/// A kd-tree in device memory, as HostKdTree.
struct KdTree {
    Buffer words;     ///< uint, see shared/kdtree.h
    Buffer addresses; ///< uint per node
    Buffer boxes;     ///< BoxRecord per node
    std::uint32_t leaf_count = 1;
    std::uint64_t references = 0; ///< to elements, in all leaves
    bool stopped = false;         ///< settings.memory kept nodes from being split
};

/// Builds the tree of build_kdtree_on_host() on the device, level by level (Zhou et al. 2008). Also
/// stops where kernels could not address a larger tree.
/// boxes: BoxRecord per element. Waits for the device once a level. Throws Error if settings.memory
/// does not hold one leaf.
KdTree build_kdtree(Device& device, const Buffer& boxes, std::uint32_t count,
                    const KdTreeSettings& settings);

/// Waits for the device.
HostKdTree download_kdtree(Device& device, const KdTree& tree);

} // namespace argand
