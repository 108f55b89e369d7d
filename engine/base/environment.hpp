#pragma once

#include <filesystem>
#include <string>

namespace argand {

/// Value of an environment variable; empty if it is not set.
std::string environment(const char* name);

/// Sets an environment variable unless it is set.
void set_default_environment(const char* name, const std::string& value);

/// Argand's cache directory by the XDG base directory specification. It may not exist yet. Empty if
/// neither XDG_CACHE_HOME nor HOME holds an absolute path.
std::filesystem::path cache_directory();

} // namespace argand
