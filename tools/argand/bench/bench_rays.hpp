#pragma once

#include "bench.hpp"
#include "device/device.hpp"

#include <vector>

namespace argand {

/// LBVH build, and primary, shadow and diffuse rays over the bench scene; beside them Embree, one
/// ray at a time on as many threads as the machine has, where the build found it.
std::vector<BenchRow> bench_rays(Device& device);

} // namespace argand
