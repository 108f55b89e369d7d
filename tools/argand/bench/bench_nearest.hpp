#pragma once

#include "accel/device_scene.hpp"
#include "bench.hpp"
#include "photon/photon_map.hpp"

namespace argand {

/// Benchmarks estimates over the k nearest photons, for several k, at points distributed like the
/// photons, against nanoflann finding the same neighbours.
std::vector<BenchRow> bench_nearest(Device& device, const DeviceScene& scene,
                                    PhotonWorkspace& workspace, const StoredPhotons& stored);

} // namespace argand
