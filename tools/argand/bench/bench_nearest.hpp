#pragma once

#include "bench.hpp"
#include "photon/photon_map.hpp"
#include "world/device_scene.hpp"

namespace argand {

/// Benchmarks estimates over the k nearest photons, for several k, at points distributed like the
/// photons, against nanoflann finding the same neighbours.
std::vector<BenchRow> bench_nearest(Device& device, const DeviceScene& scene,
                                    PhotonWorkspace& workspace, const StoredPhotons& stored);

} // namespace argand
