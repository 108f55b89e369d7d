#include "scene/gltf_uri.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

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

} // namespace

std::filesystem::path path_of_uri(const std::filesystem::path& directory, const std::string& uri,
                                  const std::string& what) {
    const std::size_t colon = uri.find(':');
    if (colon != std::string::npos && colon < uri.find_first_of("/?#")) {
        fail("{} is at '{}', which is neither a file nor base64 data", what, one_line(uri, 60));
    }
    return directory / percent_decoded(uri);
}

} // namespace argand
