#include "overwriting.hpp"

#include "base/error.hpp"
#include "base/same_file.hpp"

namespace argand {

void check_overwrites_none(const std::string& target, const std::vector<std::string>& others) {
    for (const std::string& other : others) {
        if (is_same_file(target, other)) {
            throw UsageError(fmt::format("writing '{}': it would replace '{}'; name another file",
                                         target, other));
        }
    }
}

void check_overwrites_no_file_of(const Scene& scene, const std::vector<std::string>& targets) {
    std::vector<std::string> files;
    for (const std::filesystem::path& file : scene.files) {
        files.push_back(file.string());
    }
    for (const std::string& target : targets) {
        if (!target.empty()) {
            check_overwrites_none(target, files);
        }
    }
}

} // namespace argand
