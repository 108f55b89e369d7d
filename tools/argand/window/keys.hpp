#pragma once

#include "scene/find_named.hpp"
#include "scene/scene.hpp"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace argand::window {

/// The key of an element of this kind in edits: the one by which they name it already; else its
/// name, if no earlier element has it; else its index. kind: "lights", "materials", "cameras".
template <class Range>
std::string key_in(const nlohmann::json& edits, const char* kind, const Range& range,
                   std::size_t index) {
    const nlohmann::json of_kind = edits.value(kind, nlohmann::json::object());
    for (const auto& [key, edit] : of_kind.items()) {
        if (find_named(range, key) == index) {
            return key;
        }
    }
    return find_named(range, range[index].name) == index && !range[index].name.empty()
               ? range[index].name
               : std::to_string(index);
}

/// The same for an object's node.
inline std::string key_of_object(const nlohmann::json& edits, const SceneObject& object) {
    const nlohmann::json nodes = edits.value("nodes", nlohmann::json::object());
    const bool is_named = !object.name.empty() && nodes.contains(object.name);
    return is_named ? object.name : std::to_string(object.node);
}

} // namespace argand::window
