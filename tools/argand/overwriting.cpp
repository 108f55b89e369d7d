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

} // namespace argand
