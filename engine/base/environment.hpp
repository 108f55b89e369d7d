#pragma once

#include <filesystem>
#include <string>

namespace argand {

/// Value of an environment variable; empty if it is not set.
std::string environment(const char* name);

/// Sets an environment variable unless it is set.
void set_default_environment(const char* name, const std::string& value);

/// Argand's own cache directory, after the XDG base directory specification; it need not exist.
/// Empty if there is no place for one.
std::filesystem::path cache_directory();

} // namespace argand
