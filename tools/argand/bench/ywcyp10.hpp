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
    std::vector<std::string> parts;  ///< of ywcyp10_parts(); empty: all
    std::uint64_t photons = 20'000;  ///< whose rays are compared
    int runs = 3;
};

/// making: time to make maps, by number of triangles, beside that to build a tree. images: time of
/// an image like figure 1 (a), through maps and through the tree. hits: those that rays of photons
/// find in maps, against those of the tree, by way of search, number and size of maps.
std::vector<std::string> ywcyp10_parts();

std::vector<PaperTable> bench_ywcyp10(Device& device, const Ywcyp10Settings& settings);

} // namespace argand
