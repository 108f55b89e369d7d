#pragma once

#include "methods/render.hpp"

#include <CLI/CLI.hpp>

namespace argand {

/// Adds the options of the method `footprints` to a command, as a group. `settings` outlives the
/// command.
void add_footprint_options(CLI::App& command, FootprintSettings& settings);

} // namespace argand
