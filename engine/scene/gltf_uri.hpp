#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace argand {

/// The file that a URI of a glTF file names, beside that file. what: "buffer 3". Throws Error if
/// the URI is one of another kind, or if the file is outside the directory, also by a link, unless
/// that is allowed.
std::filesystem::path path_of_uri(const std::filesystem::path& directory, const std::string& uri,
                                  const std::string& what, bool allow_external);

/// The files that a parsed glTF file names as buffers and images, wherever they are.
std::vector<std::filesystem::path> files_of_uris(const std::filesystem::path& directory,
                                                 const nlohmann::json& root);

} // namespace argand
