#pragma once

#include <string>
#include <string_view>

namespace argand {

/// Escapes text for an element or a quoted attribute of HTML or XML. Replaces control characters,
/// which XML does not allow, with question marks.
inline std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        switch (c) {
        case '&':
            safe += "&amp;";
            break;
        case '<':
            safe += "&lt;";
            break;
        case '>':
            safe += "&gt;";
            break;
        case '"':
            safe += "&quot;";
            break;
        default:
            safe += static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t' ? '?' : c;
        }
    }
    return safe;
}

} // namespace argand
