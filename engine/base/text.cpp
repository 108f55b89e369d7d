#include "base/text.hpp"

namespace argand {

std::string one_line(std::string_view text, std::size_t limit) {
    std::string line;
    bool gap = false;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte <= 0x20 || byte == 0x7f) {
            gap = !line.empty();
            continue;
        }
        if (gap) {
            line += ' ';
            gap = false;
        }
        line += c;
        if (line.size() > limit) {
            std::size_t end = limit;
            while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xc0) == 0x80) {
                --end; // not inside a UTF-8 character
            }
            return line.substr(0, end) + "...";
        }
    }
    return line;
}

} // namespace argand
