#pragma once

#include <filesystem>
#include <string>

namespace argand {

/// The file that a URI of a glTF file names, beside that file. what: "buffer 3". Throws Error if
/// the URI is one of another kind, or if the file is outside the directory, also by a link, unless
/// that is allowed.
std::filesystem::path path_of_uri(const std::filesystem::path& directory, const std::string& uri,
                                  const std::string& what, bool allow_external);

} // namespace argand
