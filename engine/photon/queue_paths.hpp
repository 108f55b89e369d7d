#pragma once

#include "photon/photon_queue.hpp"

namespace argand {

/// Boxes that meshes have left and entered, each with the moment at which that was: blocks up to
/// it were traced before.
struct MovedBoxes {
    std::vector<BoxRecord> boxes;
    std::vector<std::uint32_t> moments;
};

/// Adds boxes of a moment, slightly enlarged against rounding: `error` in scene units. Of many
/// boxes some are joined.
void add_moved_boxes(MovedBoxes& moved, std::span<const BoxRecord> boxes, std::uint32_t moment,
                     double error);

/// Forgets boxes of moments up to this one.
void forget_moved_boxes(MovedBoxes& moved, std::uint32_t moment);

/// Keeps the vertices of the paths of a block's photons. If the device cannot address so many, the
/// queue does not keep paths any more. Records only.
void keep_paths(Device& device, PhotonQueue& queue, std::uint32_t block,
                const QueueRecords& records);

/// The share of a block's photons whose paths cross one of these boxes; 0 of a block without any.
/// Waits for the device.
double share_crossed(Device& device, const PhotonQueue& queue, std::uint32_t block,
                     const MovedBoxes& moved);

/// Marks the photons of a block, or of every_block, by the last of these moments at which a box was
/// on their path. Those of blocks traced before are dropped with the next block that is added;
/// others count as if there were no such blocks. For what a block lacks, because a mesh was in the
/// way or reflected light elsewhere, blocks traced since count the more. Records only.
void mark_crossed(Device& device, const PhotonQueue& queue, std::uint32_t block,
                  const MovedBoxes& moved);

/// A part of the photons that a block emits.
struct CrossedShare {
    std::uint32_t moment = 0; ///< blocks up to this one do not count there
    double share = 0;
};

/// The parts of a block's photons by the moments at which these boxes marked them, which rise; at
/// least one. Waits for the device if there are boxes.
std::vector<CrossedShare> crossed_shares(Device& device, const PhotonQueue& queue,
                                         std::uint32_t block, const MovedBoxes& moved);

} // namespace argand
