#pragma once

#include "sweep/results.hpp"

#include <filesystem>
#include <functional>
#include <string_view>

namespace argand {

/// What is to be measured, and where it is kept.
struct TradeoffRequest {
    nlohmann::ordered_json run; ///< see Results; size, seeds and given references are added
    RenderSettings base;        ///< around which knobs are turned
    std::vector<std::string> methods;
    Extent extent = Extent::full;
    std::uint32_t seeds = 3;                            ///< at least 1: 0, 1, ...
    std::vector<std::filesystem::path> reference_files; ///< one or two; none: it is rendered
    double reference_seconds = 60;                      ///< for rendering it, about
    std::filesystem::path folder;                       ///< made if it is not there
    MethodTable table = builtin_methods();              ///< has all of `methods`
};

/// Told what is being done, and the share of that which is done.
using OnStep = std::function<void(std::string_view work, double done)>;

/// The reference of the sweep that is kept in this folder.
std::filesystem::path reference_file(const std::filesystem::path& folder);

/// Measures what is not measured yet, and keeps `tradeoff.json`, `tradeoff.csv`, the reference and
/// a picture of each setting in the folder, after each setting. Results::complete tells
/// whether `render` was interrupted. A reference that is no longer in the folder is made again.
/// Error, which says what differs, if the folder holds results of another run.
Results measure_tradeoff(const TradeoffRequest& request, const Scene& scene,
                         const RenderTrials& render, const OnStep& on_step);

} // namespace argand
