#include "scene/gltf_uri.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

namespace argand {

namespace {

/// Decodes percent-encoding (RFC 3986, section 2.1). A '%' without two hexadecimal digits after it
/// stays. ('+' is a plus sign in a path.)
std::string percent_decoded(const std::string& uri) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string decoded;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 &&
            digit(uri[i + 2]) >= 0) {
            decoded += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
            i += 2;
        } else {
            decoded += uri[i];
        }
    }
    return decoded;
}

/// Whether a path leads out of a directory, as it is written or by links. Files that do not exist
/// are where their names say.
bool leads_out(const std::filesystem::path& directory, const std::filesystem::path& path) {
    std::error_code of_folder, of_file;
    const std::filesystem::path folder =
        std::filesystem::canonical(directory.empty() ? "." : directory, of_folder);
    const std::filesystem::path file =
        std::filesystem::weakly_canonical(std::filesystem::absolute(path), of_file);
    const auto end = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return of_folder || of_file || end.first != folder.end();
}

} // namespace

std::filesystem::path path_of_uri(const std::filesystem::path& directory, const std::string& uri,
                                  const std::string& what, bool allow_external) {
    const std::size_t colon = uri.find(':');
    if (colon != std::string::npos && colon < uri.find_first_of("/?#")) {
        fail("{} is at '{}', which is neither a file nor base64 data", what, one_line(uri, 60));
    }
    const std::string decoded = percent_decoded(uri);
    if (decoded.find('\0') != std::string::npos) {
        fail("{} is at '{}', which is not the name of a file", what, one_line(uri, 60));
    }
    std::filesystem::path path = directory / decoded;
    if (!allow_external && leads_out(directory, path)) {
        fail("{} is at '{}', outside the scene's folder; --allow-external reads it all the same",
             what, one_line(uri, 60));
    }
    return path;
}

std::vector<std::filesystem::path> files_of_uris(const std::filesystem::path& directory,
                                                 const nlohmann::json& root) {
    std::vector<std::filesystem::path> files;
    for (const char* kind : {"buffers", "images"}) {
        const auto list = root.find(kind);
        if (list == root.end() || !list->is_array()) {
            continue;
        }
        for (const nlohmann::json& element : *list) {
            const bool has_uri =
                element.is_object() && element.contains("uri") && element["uri"].is_string();
            const std::string uri = has_uri ? element["uri"].get<std::string>() : "";
            if (!uri.empty() && !uri.starts_with("data:")) {
                files.push_back(directory / percent_decoded(uri));
            }
        }
    }
    return files;
}

} // namespace argand
