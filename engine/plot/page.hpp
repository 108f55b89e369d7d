#pragma once

#include "sweep/results.hpp"

#include <filesystem>

namespace argand {

/// Draws the results of the sweep in this folder, once its reference is there: writes the plot as
/// `tradeoff.png` and, with a table, and pictures and errors of what lies on the front, as
/// `tradeoff.html`, which refers to nothing outside.
void draw_results(const std::filesystem::path& folder, const Results& results);

} // namespace argand
