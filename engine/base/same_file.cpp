#include "base/same_file.hpp"

namespace argand {

namespace {

namespace fs = std::filesystem;

fs::path resolved(const fs::path& path) {
    std::error_code unreadable;
    const fs::path absolute = fs::absolute(path, unreadable);
    const fs::path canonical = fs::weakly_canonical(absolute, unreadable);
    return canonical.empty() ? absolute.lexically_normal() : canonical;
}

} // namespace

bool is_same_file(const fs::path& a, const fs::path& b) { return resolved(a) == resolved(b); }

} // namespace argand
