#pragma once

#include "device/device.hpp"
#include "fd09.hpp"

namespace argand {

/// Settings of the benchmark of simultaneous photon map queries, after Keller et al. 2010, "A
/// divide-and-conquer algorithm for simultaneous photon map queries".
struct Kdgs10Settings {
    std::uint64_t most_queries = 1'000'000;
    std::uint64_t most_photons = 10'000'000;
    int runs = 7;
};

/// Time to answer queries together, against that of a tree over the photons, for loads from 10^3
/// queries and 10^4 photons up to the most, by powers of ten. Photons lie on the walls of a cube.
/// Queries lie near them, on all walls, or far from most, on a hundredth of the area; they come row
/// by row as an eye's hits do, or scattered. A photon map of more photons than the device can
/// address is left out.
PaperTable bench_kdgs10(Device& device, const Kdgs10Settings& settings);

} // namespace argand
