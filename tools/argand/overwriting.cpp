#include "overwriting.hpp"

#include "base/error.hpp"

#include <filesystem>

namespace argand {

namespace {

/// The path without links, `.` and `..` in the part of it that exists.
std::filesystem::path resolved(const std::string& path) {
    std::error_code unreadable;
    const std::filesystem::path absolute = std::filesystem::absolute(path, unreadable);
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(absolute, unreadable);
    return canonical.empty() ? absolute.lexically_normal() : canonical;
}

} // namespace

void check_overwrites_none(const std::string& target, const std::vector<std::string>& others) {
    for (const std::string& other : others) {
        if (resolved(target) == resolved(other)) {
            throw UsageError(fmt::format("writing '{}': it would replace '{}'; name another file",
                                         target, other));
        }
    }
}

} // namespace argand
