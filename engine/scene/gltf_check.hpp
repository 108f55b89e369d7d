#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace argand {

/// Parses glTF's JSON text. Error if it is not JSON, is no object, or is nested so deeply that a
/// recursive reader would run out of stack.
nlohmann::json parse_gltf_json(std::string_view text);

/// Checks that the file is of version 2 and needs no later one. Error that names the version.
void check_gltf_version(const nlohmann::json& root);

/// Checks what tinygltf takes without a word: an index or a size that is negative, fractional,
/// text, or too large for its type (tinygltf ignores the first three and wraps the last), and
/// factors that are no numbers. Extensions and extras are not looked into. Error that names the
/// property.
void check_gltf_json(const nlohmann::json& root);

} // namespace argand
