#pragma once

#include "photon/photon_queue.hpp"

namespace argand {

/// How footprints of a queue's records are made.
struct QueueFootprints {
    const DeviceScene& scene;
    FootprintScale scale;
};

/// Makes the footprints of the queue's records in the order of their cells, for a map that knows
/// its area samples. Returns the boxes of the cells around them (queue_box.h), in scratch memory.
/// Waits for the device.
Buffer add_queue_footprints(Device& device, PhotonQueue& queue, const QueueFootprints& how,
                            PhotonMap& map);

/// Makes the footprints of the area samples, which are as wide as those of photons nearby, from
/// all that is in the queue. They are kept, and only get as much wider or narrower as those of
/// photons (add_queue_footprints). workspace: its memory is used. Waits for the device.
void size_area_footprints(Device& device, PhotonQueue& queue, PhotonWorkspace& workspace,
                          const QueueFootprints& how);

/// Copies a map's photons, in its order, and what the queue keeps for their footprints, if there
/// are any, to a workspace, which is made anew if it is too small.
void copy_to_workspace(Device& device, const PhotonQueue& queue, const Buffer& photons,
                       PhotonWorkspace& workspace);

} // namespace argand
