#pragma once

#include "methods/table.hpp"
#include "sweep/results.hpp"

#include <filesystem>

namespace argand {

/// Draws the results of the sweep in this folder: the plot as `tradeoff.svg`, and the page
/// `tradeoff.html` with the plot, a table of all settings, and the pictures and errors of those on
/// the Pareto front. The page refers to nothing outside itself. Draws nothing before the folder has
/// a reference.
void draw_results(const std::filesystem::path& folder, const Results& results,
                  MethodTable table = builtin_methods());

} // namespace argand
