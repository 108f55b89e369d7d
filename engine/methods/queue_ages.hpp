#pragma once

#include "photon/photon_queue.hpp"

#include <cstdint>
#include <vector>

namespace argand {

/// A block of the queue: its photons, and how much older they are than those of the last frame, in
/// half-lives.
struct BlockAge {
    std::uint64_t emitted = 0;
    double half_lives = 0;
};

/// Sets the weights of the queue's blocks, which sum to 1, by the ages of these blocks.
void weigh_blocks(PhotonQueue& queue, const std::vector<BlockAge>& ages);

/// Photons of even weight that have the noise of those in the queue as they are weighed: Kish's
/// effective number, (sum w)^2 / sum w^2. 0 if there are none.
double effective_photons(const PhotonQueue& queue, const std::vector<BlockAge>& ages);

} // namespace argand
