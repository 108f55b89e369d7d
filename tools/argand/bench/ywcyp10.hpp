#pragma once

#include "device/device.hpp"
#include "fd09.hpp"

#include <string>
#include <vector>

namespace argand {

/// Settings of the benchmark of photon tracing through cube maps, after Yao et al. 2010,
/// "Multi-image based photon tracing for interactive global illumination of dynamic scenes".
struct Ywcyp10Settings {
    std::vector<std::string> scenes; ///< glTF files; empty: this project's own scenes
    std::uint64_t photons = 20'000;  ///< whose rays are compared
    int runs = 3;
};

/// Hits that rays of photons find in cube maps, against those of the tree: by way of search, by
/// number of maps, and by their size.
PaperTable bench_cube_hits(Device& device, const Ywcyp10Settings& settings);

/// Time to make the maps of a scene and time to build its tree, by number of triangles.
PaperTable bench_cube_making(Device& device);

} // namespace argand
