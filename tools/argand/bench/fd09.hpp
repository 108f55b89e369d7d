#pragma once

#include "device/device.hpp"
#include "methods/render.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace argand {

/// What is measured of Fabianowski and Dingliana 2009, "Interactive global photon mapping", and
/// how.
struct Fd09Settings {
    std::vector<std::string> scenes;          ///< glTF files; none: this project's own
    std::vector<std::string> parts;           ///< of fd09_parts(); none: all
    int size = 256;                           ///< of the square pictures whose speed is measured
    int error_size = 96;                      ///< of those whose error is
    std::uint64_t photons = 0;                ///< emitted; 0: as many as in the paper
    std::uint32_t reference_samples = 256;    ///< a pixel, of each of two references
    std::vector<double> budgets{3.5, 11, 40}; ///< seconds in which the methods' errors are compared
    int runs = 7;
};

/// One column per row of the paper's kind: JSON objects with the same keys.
struct PaperTable {
    std::string title;
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
};

std::vector<std::string> fd09_parts();

/// Measures scene by scene.
std::vector<PaperTable> bench_fd09(Device& device, const Fd09Settings& settings);

/// The table in Markdown, a line per key and a column per row.
std::string markdown(const PaperTable& table);

// The parts; each adds what it found about a scene to its tables.

/// Table 1: rates of gathering over leaf sizes, both builds; and how long these take.
void measure_trees(Device& device, const Scene& scene, const RenderSettings& render, int runs,
                   PaperTable& linear, PaperTable& heuristic, PaperTable& builds);

/// Table 2 and figure 4: time at equal error of the estimators and of the kernels.
void measure_errors(Device& device, const Scene& scene, const RenderSettings& render,
                    std::uint32_t reference_samples, PaperTable& estimators, PaperTable& kernels);

/// The error that each method reaches in so many seconds of the clock.
void measure_budgets(Device& device, const Scene& scene, RenderSettings render,
                     const std::vector<double>& budgets, std::uint32_t reference_samples,
                     PaperTable& table);

/// Table 3: footprints by radius.
void measure_radii(Device& device, const Scene& scene, const RenderSettings& render,
                   PaperTable& radii);

/// Figure 5: where the time of a picture goes.
void measure_shares(Device& device, const Scene& scene, const RenderSettings& render, int runs,
                    PaperTable& shares);

} // namespace argand
