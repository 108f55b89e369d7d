#pragma once

#include "device/device.hpp"
#include "methods/render_settings.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace argand {

/// Settings of the benchmark that repeats the measurements of Fabianowski and Dingliana 2009,
/// "Interactive global photon mapping".
struct Fd09Settings {
    std::vector<std::string> scenes;          ///< glTF files; empty: this project's own scenes
    std::vector<std::string> parts;           ///< of fd09_parts(); empty: all
    int size = 256;                           ///< edge of the square images for timing
    int error_size = 96;                      ///< edge of the square images for errors
    std::uint64_t photons = 0;                ///< emitted photons; 0: as many as in the paper
    std::uint32_t reference_samples = 256;    ///< per pixel, of each of two references
    std::vector<double> budgets{3.5, 11, 40}; ///< seconds at which errors are compared
    int runs = 7;
};

/// A table of the paper, transposed for printing: each row is a JSON object, all with the same
/// keys.
struct PaperTable {
    std::string title;
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
};

/// Table 1 and section 6.2: the linear build, the voxel volume heuristic, and both compared.
struct TreeTables {
    PaperTable linear{"Table 1: linear build, 10^3 queries/s over leaf sizes"};
    PaperTable heuristic{"Table 1: voxel volume heuristic, 10^3 queries/s over leaf sizes"};
    PaperTable builds{"Section 6.2: the two builds, at T_auto"};
};

std::vector<std::string> fd09_parts();

/// The glTF files of a benchmark: those given, or those of these names among this project's own.
/// Throws Error if there is one that does not exist.
std::vector<std::string> scene_files(const std::vector<std::string>& given,
                                     std::span<const char* const> own);

/// Measures one scene after the other.
std::vector<PaperTable> bench_fd09(Device& device, const Fd09Settings& settings);

/// The table in Markdown, with a line per key and a column per row.
std::string markdown(const PaperTable& table);
/// The table in Markdown, with a line per row and a column per key.
std::string markdown_rows(const PaperTable& table);

// Each of the following adds its results for a scene to its tables.

/// Table 1: gathering rates over leaf sizes for both builds, and the build times.
void measure_trees(Device& device, const Scene& scene, const RenderSettings& render, int runs,
                   TreeTables& tables);

/// Table 2 and figure 4: time at equal error, of estimators and of kernels.
void measure_errors(Device& device, const Scene& scene, const RenderSettings& render,
                    std::uint32_t reference_samples, PaperTable& estimators, PaperTable& kernels);

/// Error of each method after the given seconds of wall clock time.
void measure_budgets(Device& device, const Scene& scene, RenderSettings render,
                     const std::vector<double>& budgets, std::uint32_t reference_samples,
                     PaperTable& table);

/// Table 3: footprints by radius.
void measure_radii(Device& device, const Scene& scene, const RenderSettings& render,
                   PaperTable& radii);

/// Figure 5: how the time of an image divides into phases.
void measure_shares(Device& device, const Scene& scene, const RenderSettings& render, int runs,
                    PaperTable& shares);

} // namespace argand
