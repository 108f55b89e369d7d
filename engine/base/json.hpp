#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace argand {

/// json_text() writes no line break but the last.
inline constexpr int one_line_of_json = -1;

/// Formats JSON with `indent` spaces per level and a newline at the end. Numbers that JSON cannot
/// express (infinity, NaN) become null. Bytes that are not UTF-8, which file names may hold, become
/// U+FFFD.
std::string json_text(const nlohmann::ordered_json& value, int indent = 2);

/// Reads a file of JSON. Throws Error, which says where, if it cannot be read, is none, or is
/// nested more than 64 levels deep.
nlohmann::json read_json(const std::filesystem::path& path);

/// Writes `json_text` to a file in one step (base/atomic_write.hpp).
void write_json(const std::filesystem::path& target, const nlohmann::ordered_json& value);

} // namespace argand
