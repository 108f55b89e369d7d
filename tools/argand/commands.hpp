#pragma once

#include "methods/table.hpp"
#include "view_window.hpp"

#include <CLI/CLI.hpp>
#include <span>
#include <string>

namespace argand {

/// Each adds a subcommand to the command line, which runs when that is parsed. `methods` are those
/// that the user may choose from.
/// command_line: what the user typed, for the files.
void add_render_command(CLI::App& app, MethodTable methods, const std::string& command_line);
/// arguments: all of the program's.
void add_view_command(CLI::App& app, MethodTable methods, std::span<const char* const> arguments,
                      ShowInWindow window);
void add_compare_command(CLI::App& app);
void add_compare_backends_command(CLI::App& app, MethodTable methods);
void add_tradeoff_command(CLI::App& app, MethodTable methods);
void add_inspect_command(CLI::App& app, MethodTable methods);
void add_devices_command(CLI::App& app);
void add_bench_command(CLI::App& app);

} // namespace argand
