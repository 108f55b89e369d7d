#pragma once

#include "device/count.hpp"
#include "device/device.hpp"

namespace argand {

/// Linear bounding volume hierarchy over boxes (Karras 2012: "Maximizing parallelism in the construction of BVHs,
/// octrees, and k-d trees"): leaf i of n is order[i]; inner node 0 is the root where n > 1.
struct Lbvh {
    Buffer order;                       ///< uint per leaf: index of the box
    Buffer nodes;                       ///< LbvhNode per inner node (n − 1)
};

/// Records only. boxes: BoxRecord each; 30-bit Morton codes of their centres in their common bounds; equal codes are
/// told apart by their place in the order.
Lbvh build_lbvh(Device& device, const Buffer& boxes, const Count& count);

} // namespace argand
