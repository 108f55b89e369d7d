#include "base/json_members.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

#include <fmt/ranges.h>
#include <utility>

namespace argand {

JsonMembers::JsonMembers(const nlohmann::json& object, std::string where, std::string doing)
    : object_(object), where_(std::move(where)), doing_(std::move(doing)) {
    if (!object.is_object()) {
        fail("{}: {} is no JSON object; write {{...}} there", doing_, where_);
    }
}

const nlohmann::json* JsonMembers::find(const char* key) {
    known_.insert(key);
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
}

void JsonMembers::complain(const char* key, std::string_view expected) const {
    fail("{}: '{}' of {} is not {}", doing_, key, where_, expected);
}

void JsonMembers::end() const {
    for (const auto& [name, value] : object_.items()) {
        if (!known_.contains(name)) {
            fail("{}: {} has a member '{}', which there is not; there are {}", doing_, where_,
                 one_line(name, 60), fmt::join(known_, ", "));
        }
    }
}

} // namespace argand
