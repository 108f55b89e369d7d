#pragma once

#include "bench.hpp"

namespace argand {

/// Photons emitted, traced and stored per second in a Cornell box; photons sorted and built into a
/// map; eye paths with a query of the map each; the nearest photons.
std::vector<BenchRow> bench_photons(Device& device);

} // namespace argand
