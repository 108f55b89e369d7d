#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace argand {

/// Throws UsageError unless all these are methods' names.
void check_methods(const std::vector<std::string>& names);

/// Throws UsageError if the command was given an option that has no effect with the method.
void check_method_options(const CLI::App& command, const std::string& method);

} // namespace argand
