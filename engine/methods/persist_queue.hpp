#pragma once

#include "base/archive.hpp"
#include "photon/photon_queue.hpp"

namespace argand {

/// Saves a photons queue, or loads it into an empty one of the same window. Waits for the device.
/// Throws Error on values that no queue saves.
void persist_queue(Archive& archive, Device& device, PhotonQueue& queue);

} // namespace argand
