#pragma once

#include "bench.hpp"

namespace argand {

/// Benchmarks photons in a Cornell box: tracing and storing them, sorting them into a map, eye
/// paths with a query each, and queries for the nearest photons.
std::vector<BenchRow> bench_photons(Device& device);

} // namespace argand
