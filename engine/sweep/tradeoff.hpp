#pragma once

#include "sweep/results.hpp"

#include <filesystem>
#include <functional>
#include <string_view>

namespace argand {

/// A sweep to measure, and the folder that keeps it.
struct TradeoffRequest {
    nlohmann::ordered_json run; ///< Results::run, without size, seeds and references
    RenderSettings base;        ///< the default setting of every method
    std::vector<std::string> methods;
    Extent extent = Extent::full;
    std::uint32_t seeds = 3;                            ///< at least 1: 0, 1, ...
    std::vector<std::filesystem::path> reference_files; ///< one or two; none: render it
    double reference_seconds = 60;         ///< approximate time for rendering the reference
    std::filesystem::path folder;          ///< created if it does not exist
    MethodTable table = builtin_methods(); ///< holds all of `methods`
};

/// Called with the current step and its progress in [0, 1].
using OnStep = std::function<void(std::string_view work, double done)>;

/// The file in a sweep's folder that keeps its reference.
std::filesystem::path reference_file(const std::filesystem::path& folder);

/// Measures the settings that are not measured yet. After each setting, writes `tradeoff.json`,
/// `tradeoff.csv` and a picture of the setting to the folder. Renders the reference if the folder
/// has none. Results::complete is false if `render` was interrupted. Throws Error, which says what
/// differs, if the folder holds results of another run.
Results measure_tradeoff(const TradeoffRequest& request, const Scene& scene,
                         const RenderTrials& render, const OnStep& on_step);

} // namespace argand
