#include "base/text.hpp"

#include <cstdint>

namespace argand {
namespace {

/// Length in bytes of the first character of `text`; 0 if it is not valid UTF-8 (RFC 3629).
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    const std::uint8_t first = byte(0);
    const std::size_t length = first < 0x80    ? 1
                               : first < 0xc2  ? 0 // a continuation, or an overlong form
                               : first < 0xe0  ? 2
                               : first < 0xf0  ? 3
                               : first <= 0xf4 ? 4
                                               : 0;
    if (length > text.size()) {
        return 0;
    }
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) {
            return 0;
        }
    }
    const bool overlong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
    const bool surrogate = first == 0xed && byte(1) >= 0xa0;
    const bool too_large = first == 0xf4 && byte(1) >= 0x90;
    return overlong || surrogate || too_large ? 0 : length;
}

} // namespace

std::string one_line(std::string_view text, std::size_t limit) {
    std::string line;
    bool gap = false;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        const std::string_view character = length == 0 ? "?" : text.substr(0, length);
        text.remove_prefix(length == 0 ? 1 : length);
        // Control characters: C0 and DEL, and C1 (U+0080 to U+009F).
        const auto first = static_cast<std::uint8_t>(character[0]);
        const bool c1 = first == 0xc2 && static_cast<std::uint8_t>(character[1]) < 0xa0;
        if (first <= 0x20 || first == 0x7f || c1) {
            gap = !line.empty();
            continue;
        }
        if (line.size() + (gap ? 1 : 0) + character.size() > limit) {
            return line + "...";
        }
        if (gap) {
            line += ' ';
            gap = false;
        }
        line += character;
    }
    return line;
}

} // namespace argand
