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

} // namespace

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
            buffer["byteLength"] = 1;
            any = true;
        }
    }
    return any;
}

} // namespace argand
