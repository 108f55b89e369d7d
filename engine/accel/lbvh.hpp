#pragma once

#include "device/count.hpp"
#include "device/device.hpp"

namespace argand {

/// Linear bounding volume hierarchy over boxes in the layout of Karras 2012 ("Maximizing
/// parallelism in the construction of BVHs, octrees, and k-d trees"). See LbvhNode in
/// shared/accel_records.h for the layout.
struct Lbvh {
    Buffer order;   ///< uint per leaf: index of the box
    Buffer nodes;   ///< LbvhNode: inner node i at 2 i, leaf i at 2 i + 1, 2 n in all
    Buffer costs;   ///< ForestCost per inner node; only for rays
    Buffer parents; ///< uint per inner node, see lbvh_fit.comp; only for rays
};

/// Records only. boxes: BoxRecord each; 30-bit Morton codes of their centres in their common
/// bounds; equal codes are told apart by their place in the order. The root is node 0, or 1 (the
/// leaf) where there is one box.
Lbvh build_lbvh(Device& device, const Buffer& boxes, const Count& count, bool for_rays = false);

/// How far each of some sorted codes is from the next one, a uint each in scratch memory
/// (code_distance of shared/morton.h). wide: codes of 64 bits, low word first.
Buffer code_distances(Device& device, const Buffer& codes, const Count& count, bool wide);

/// As build_lbvh, over boxes in the order of some codes, so far from each other. `order` holds what
/// the leaves' nodes shall refer to; it becomes Lbvh::order.
Lbvh build_lbvh_in_order(Device& device, const Buffer& boxes, const Buffer& distances,
                         const Buffer& order, const Count& count);

} // namespace argand
