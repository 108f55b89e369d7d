#pragma once

#include "accel/device_scene.hpp"
#include "bench.hpp"
#include "photon/photon_map.hpp"

namespace argand {

/// Estimates over the k nearest photons per second, for several k, at points spread like the
/// photons are, beside nanoflann finding the same neighbours.
std::vector<BenchRow> bench_nearest(Device& device, const DeviceScene& scene,
                                    PhotonWorkspace& workspace, const StoredPhotons& stored);

} // namespace argand
