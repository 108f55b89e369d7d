#pragma once

#include "photon/queue_footprints.hpp"

#include <optional>

namespace argand {

/// The photon map of what is in the queue, with the photons' flux times the weights of their
/// blocks. footprints: of a queue that keeps what they are made of. Waits for the device.
PhotonMap map_of_queue(Device& device, PhotonQueue& queue, const SampledPart& corrected,
                       const std::optional<QueueFootprints>& footprints = std::nullopt);

} // namespace argand
