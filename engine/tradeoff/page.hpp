#pragma once

#include "tradeoff/results.hpp"

#include <filesystem>

namespace argand {

/// Writes the plot as `tradeoff.png` and, with a table, and pictures and errors of what lies on the
/// front, as `tradeoff.html`, which refers to nothing outside.
void draw_results(const std::filesystem::path& folder, const Results& results,
                  const Reference& reference);

} // namespace argand
