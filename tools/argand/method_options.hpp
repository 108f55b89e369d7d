#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace argand {

/// Throws UsageError if the command was given an option that has no effect with the method.
void check_method_options(const CLI::App& command, const std::string& method);

} // namespace argand
