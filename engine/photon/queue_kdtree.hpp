#pragma once

#include "accel/kdtree.hpp"
#include "photon/photon_queue.hpp"

namespace argand {

/// A queue of one block that holds these records, all of them not empty and of weight 1, in the
/// leaves of a kd-tree of their own, built on the device (build_kdtree): what Shi 2012 compares the
/// queue with ("standard approach", §4.1). reach: radius of search. Waits for the device.
PhotonQueue sort_by_kdtree(Device& device, const PhotonWorkspace& workspace, std::uint64_t records,
                           double reach, std::uint32_t leaf_size, bool parts_caustics);

} // namespace argand
