#pragma once

#include <filesystem>
#include <string>

namespace argand {

/// The file that a URI of a glTF file names, beside that file. what: "buffer 3". Throws Error if
/// the URI is one of another kind.
std::filesystem::path path_of_uri(const std::filesystem::path& directory, const std::string& uri,
                                  const std::string& what);

} // namespace argand
