#pragma once

#include "bench.hpp"
#include "device/device.hpp"

#include <vector>

namespace argand {

/// Benchmarks the builds of the LBVH and of the kd-tree, and primary, shadow and diffuse rays
/// through either in the bench scene, against Embree (if the build found it) tracing one ray at a
/// time on all of the machine's threads.
std::vector<BenchRow> bench_rays(Device& device);

} // namespace argand
