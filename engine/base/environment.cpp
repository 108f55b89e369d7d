#include "base/environment.hpp"

#include <cstdlib>

namespace argand {

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

void set_default_environment(const char* name, const std::string& value) {
#ifdef _WIN32
    if (!std::getenv(name)) {
        _putenv_s(name, value.c_str());
    }
#else
    setenv(name, value.c_str(), 0);
#endif
}

std::filesystem::path cache_directory() {
    // By the specification, a relative XDG_CACHE_HOME is ignored.
    if (const std::filesystem::path xdg = environment("XDG_CACHE_HOME"); xdg.is_absolute()) {
        return xdg / "argand";
    }
    if (const std::filesystem::path home = environment("HOME"); home.is_absolute()) {
        return home / ".cache" / "argand";
    }
    return {};
}

} // namespace argand
