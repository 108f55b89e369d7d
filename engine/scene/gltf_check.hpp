#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace argand {

/// Parses glTF's JSON text. Throws Error if the text is not JSON or not an object, or is nested so
/// deeply that a recursive reader would overflow its stack.
nlohmann::json parse_gltf_json(std::string_view text);

/// Whether a property of core glTF holds integers, or a list of them, wherever it occurs.
bool holds_integers(const std::string& key);

/// Checks that the file is glTF 2 and needs no later version. The Error names the version.
void check_gltf_version(const nlohmann::json& root);

/// Checks for mistakes that tinygltf accepts silently: an index or size that is negative,
/// fractional, text, or too large for its type (tinygltf ignores the first three and wraps the
/// last), and factors that are not numbers. Skips extensions and extras. The Error names the
/// property.
void check_gltf_json(const nlohmann::json& root);

} // namespace argand
