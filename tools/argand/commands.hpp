#pragma once

#include <CLI/CLI.hpp>

namespace argand {

/// Each adds a subcommand to the command line; it runs where that is parsed.
void add_render_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_compare_backends_command(CLI::App& app);
void add_tradeoff_command(CLI::App& app);
void add_inspect_command(CLI::App& app);
void add_devices_command(CLI::App& app);
void add_bench_command(CLI::App& app);

} // namespace argand
