#include "scene/gltf_numbers.hpp"

#include "scene/gltf_check.hpp"
#include "scene/gltf_compression.hpp"
#include "scene/gltf_value.hpp"
#include <cmath>

namespace argand {
namespace {

using nlohmann::json;

/// Rewrites a number that is an integer from 0 to 2^53.
bool rewrite(json& value) {
    if (!value.is_number_float()) {
        return false;
    }
    const auto number = value.get<double>();
    if (!(number >= 0 && number <= 0x1p53 && std::floor(number) == number)) {
        return false;
    }
    value = static_cast<std::uint64_t>(number);
    return true;
}

/// all: every number in `value` is rewritten, whatever the key.
bool rewrite_in(json& value, const std::string& key, bool all) {
    all = all || holds_integers(key);
    if (!value.is_structured()) {
        return all && rewrite(value);
    }
    bool any = false;
    if (value.is_array()) {
        for (json& element : value) {
            any = rewrite_in(element, key, all) || any;
        }
        return any;
    }
    for (const auto& [name, member] : value.items()) {
        if (name != "extras") {
            const bool accessors = key == "attributes" || key == "targets";
            any = rewrite_in(member, name, accessors || name == "extensions" || all) || any;
        }
    }
    return any;
}

/// Gives the indices of a compressed primitive the buffer view of their compressed data. Returns
/// whether they had none.
bool give_view(json& root, const json& primitive) {
    const json* extension = find_extension(&primitive, draco_extension);
    const json* view = find_member(extension, "bufferView");
    const json* indices = find_member(&primitive, "indices");
    if (!view || !view->is_number_unsigned() || !indices || !indices->is_number_unsigned() ||
        !root.contains("accessors") || !root["accessors"].is_array()) {
        return false;
    }
    json& accessors = root["accessors"];
    const auto index = indices->get<std::size_t>();
    if (index >= accessors.size() || !accessors[index].is_object() ||
        accessors[index].contains("bufferView")) {
        return false;
    }
    accessors[index]["bufferView"] = *view;
    return true;
}

} // namespace

bool give_indices_views(json& root) {
    const auto meshes = root.find("meshes");
    bool any = false;
    if (meshes == root.end() || !meshes->is_array()) {
        return any;
    }
    for (const json& mesh : *meshes) {
        const json* primitives = find_member(&mesh, "primitives");
        if (primitives && primitives->is_array()) {
            for (const json& primitive : *primitives) {
                any = give_view(root, primitive) || any;
            }
        }
    }
    return any;
}

bool rewrite_integers(json& root) { return rewrite_in(root, "", false); }

bool fill_fallback_buffers(json& root) {
    const auto buffers = root.find("buffers");
    bool any = false;
    if (buffers == root.end() || !buffers->is_array()) {
        return any;
    }
    for (json& buffer : *buffers) {
        const json* extension = find_extension(&buffer, meshopt_extension);
        const json* fallback = find_member(extension, "fallback");
        if (fallback && fallback->is_boolean() && fallback->get<bool>() &&
            !buffer.contains("uri")) {
            buffer["uri"] = "data:application/octet-stream;base64,AA==";
            buffer["byteLength"] = 1u;
            any = true;
        }
    }
    return any;
}

} // namespace argand
