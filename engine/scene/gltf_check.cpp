#include "scene/gltf_check.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>

namespace argand {
namespace {

using nlohmann::json;

constexpr int deepest_nesting = 64; // glTF itself needs about ten
constexpr std::uint64_t largest_int = std::numeric_limits<std::int32_t>::max();
// The integers that JSON numbers represent exactly.
constexpr std::uint64_t largest_size = std::uint64_t(1) << 53;

// Properties that hold an index or a list of indices wherever they occur in core glTF.
constexpr std::array index_keys{"buffer",        "bufferView",
                                "camera",        "children",
                                "indices",       "input",
                                "joints",        "material",
                                "mesh",          "mode",
                                "node",          "nodes",
                                "output",        "sampler",
                                "scene",         "skeleton",
                                "skin",          "source",
                                "index",         "texCoord",
                                "componentType", "inverseBindMatrices"};
constexpr std::array size_keys{"byteOffset", "byteLength", "byteStride", "count"};
// Properties that hold a number or several.
constexpr std::array number_keys{"alphaCutoff",
                                 "aspectRatio",
                                 "baseColorFactor",
                                 "emissiveFactor",
                                 "matrix",
                                 "metallicFactor",
                                 "rotation",
                                 "roughnessFactor",
                                 "scale",
                                 "translation",
                                 "weights",
                                 "xmag",
                                 "yfov",
                                 "ymag",
                                 "zfar",
                                 "znear"};

template <std::size_t N>
bool is_one_of(const std::string& key, const std::array<const char*, N>& keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

void check_integer(const json& value, const std::string& key, std::uint64_t largest) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > largest) {
        fail("\"{}\" must be an integer from 0 to {}, not {}", one_line(key, 40), largest,
             one_line(value.dump(-1, ' ', true), 40));
    }
}

void check_number(const json& value, const std::string& key) {
    if (!value.is_number()) {
        fail("\"{}\" must be made of numbers, not {}", one_line(key, 40),
             one_line(value.dump(-1, ' ', true), 40));
    }
}

// `index`: each scalar in `value` is an index, whatever the key.
void check_value(const json& value, const std::string& key, bool index) {
    index = index || is_one_of(key, index_keys);
    if (value.is_object()) {
        const bool attributes =
            key == "attributes" || key == "targets"; // of a mesh primitive: name → accessor
        for (const auto& [name, member] : value.items()) {
            if (name != "extensions" && name != "extras") {
                check_value(member, name, attributes);
            }
        }
    } else if (value.is_array()) {
        for (const json& element : value) {
            if (element.is_structured() || index) {
                check_value(element, key, index);
            } else if (is_one_of(key, number_keys)) {
                check_number(element, key);
            }
        }
    } else if (index) {
        check_integer(value, key, largest_int);
    } else if (is_one_of(key, size_keys)) {
        check_integer(value, key, largest_size);
    } else if (is_one_of(key, number_keys)) {
        check_number(value, key);
    }
}

// tinygltf stores the count and offsets of a sparse accessor as int.
void check_sparse(const json& root) {
    const auto accessors = root.find("accessors");
    if (accessors == root.end() || !accessors->is_array()) {
        return;
    }
    for (const json& accessor : *accessors) {
        if (!accessor.is_object() || !accessor.contains("sparse") ||
            !accessor["sparse"].is_object()) {
            continue;
        }
        const json& sparse = accessor["sparse"];
        if (sparse.contains("count")) {
            check_integer(sparse["count"], "count", largest_int);
        }
        for (const char* part : {"indices", "values"}) {
            if (sparse.contains(part) && sparse[part].is_object() &&
                sparse[part].contains("byteOffset")) {
                check_integer(sparse[part]["byteOffset"], "byteOffset", largest_int);
            }
        }
    }
}

} // namespace

json parse_gltf_json(std::string_view text) {
    json root;
    try {
        root = json::parse(text.begin(), text.end(), [](int depth, json::parse_event_t, json&) {
            if (depth > deepest_nesting) {
                fail("its JSON is nested more than {} levels deep", deepest_nesting);
            }
            return true;
        });
    } catch (const json::exception& problem) {
        const std::string message = problem.what();
        const std::size_t prefix = message.find("] "); // "[json.exception.parse_error.101] "
        fail("its JSON is not valid: {}",
             one_line(prefix == std::string::npos ? message : message.substr(prefix + 2)));
    }
    if (!root.is_object()) {
        fail("its JSON is not an object");
    }
    return root;
}

bool holds_integers(const std::string& key) {
    return is_one_of(key, index_keys) || is_one_of(key, size_keys);
}

void check_gltf_version(const json& root) {
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object() || !asset->contains("version")) {
        fail("it is not glTF: it has no \"asset\" with a \"version\"");
    }
    // minVersion, where given, is the version that a reader must support at least: glTF 2.0,
    // section 3.2.
    const json& version =
        asset->contains("minVersion") ? (*asset)["minVersion"] : (*asset)["version"];
    const std::string text = version.is_string() ? version.get<std::string>() : "";
    const bool good = asset->contains("minVersion") ? text == "2.0" : text.starts_with("2.");
    if (!good) {
        fail("it is glTF of version {}; only version 2.0 is supported",
             one_line(version.dump(-1, ' ', true), 40));
    }
}

void check_gltf_json(const json& root) {
    for (const auto& [key, value] : root.items()) {
        if (key != "extensions" && key != "extras") {
            check_value(value, key, false);
        }
    }
    check_sparse(root);
}

} // namespace argand
