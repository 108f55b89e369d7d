#pragma once

#include "fd09.hpp"
#include "scene/scene.hpp"
#include "sweep/trials.hpp"

#include <functional>
#include <string>

namespace argand {

/// What the user asked `argand bench --paper shi12` for.
struct Shi12Options {
    std::string scenes = "assets";       ///< folder of dynamic_shi.glb
    std::string folder = "argand_shi12"; ///< for shi12.json and shi12.md
    bool quick = false;                  ///< small loads and pictures, for a minute
    int runs = 7;
};

/// Measures what the figures of Shi 2012 show, with the parameters of its table 3: construction
/// (figure 4.1), memory (4.2, 4.3), search (4.4, 4.5), and frames of a moving light (4.11 to 4.13).
/// Keeps each row in shi12.json, takes those that the same build has measured there on the same
/// device, and writes the page shi12.md. Throws Error if it is interrupted, or if the scene is
/// missing.
void bench_shi12(const OpenDevice& open, const Shi12Options& options);

/// A load of photons on the device, in blocks.
struct Shi12Load {
    std::uint64_t photons = 200'000; ///< emitted, of all blocks
    std::uint32_t window = 10;       ///< blocks
};

/// A row of figure 4.1, for this load: seconds to add a block to the queue and to build trees over
/// all photons.
nlohmann::ordered_json measure_construction(Device& device, const Scene& scene,
                                            const Shi12Load& load, int runs);

/// A row of figures 4.2 and 4.3. Opens a device for each structure.
nlohmann::ordered_json measure_memory(const OpenDevice& open, const Scene& scene,
                                      const Shi12Load& load);

/// A row of figure 4.4 or 4.5: seconds of the searches of a picture of this size. in_disc: photons
/// that a disc would hold on average if 200,000 were emitted, which tells the radius.
nlohmann::ordered_json measure_search(Device& device, const Scene& scene, const Shi12Load& load,
                                      double in_disc, int size, int runs);

/// Rows of figures 4.11 to 4.13: time and error of each frame of the thesis's film, by the queue as
/// in the thesis, by the queue as it is here, and by photons that are all traced anew.
nlohmann::ordered_json measure_shi_film(const OpenDevice& open, Scene scene, const Shi12Load& load,
                                        int size, std::uint32_t reference_samples);

} // namespace argand
