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

/// Builds a hierarchy over boxes (BoxRecord), sorted by the 30-bit Morton codes of their centres in
/// their common bounds. Equal codes are told apart by their place in the order. The root is node 0,
/// or node 1 (a leaf) if there is only one box. Records only.
Lbvh build_lbvh(Device& device, const Buffer& boxes, const Count& count, bool for_rays = false);

/// The distance of each sorted code from the next one (code_distance of shared/morton.h), a uint
/// each in scratch memory. codes64: codes of 64 bits, low word first; else of 32 bits.
Buffer code_distances(Device& device, const Buffer& codes, const Count& count, bool codes64);

/// As build_lbvh, over boxes in the order of codes with these distances. order: a uint per box to
/// which the node of its leaf refers; it becomes Lbvh::order.
Lbvh build_lbvh_in_order(Device& device, const Buffer& boxes, const Buffer& distances,
                         const Buffer& order, const Count& count);

} // namespace argand
