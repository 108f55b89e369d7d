#pragma once

#include "methods/method_info.hpp"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace argand {

/// Adds every option that some method lists, once. An option of a single method stands in a group
/// of that method. `settings` must outlive the command.
void add_method_options(CLI::App& command, RenderSettings& settings, MethodTable methods);

/// One line for each method, for the end of a command's help.
std::string describe_methods(MethodTable methods);

/// Whether the user gave the option; false if the command does not have it.
bool is_given(const CLI::App& command, const std::string& option);

/// Throws UsageError unless all these are names of methods.
void check_methods(const std::vector<std::string>& names, MethodTable methods);

/// Throws UsageError if the user gave an option that has no effect with the method.
void check_method_options(const CLI::App& command, const MethodInfo& method, MethodTable methods);

} // namespace argand
