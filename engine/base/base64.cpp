#include "base/base64.hpp"

namespace argand {

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = bytes.size() - i;
        const std::uint32_t word = std::uint32_t{bytes[i]} << 16 |
                                   (count > 1 ? std::uint32_t{bytes[i + 1]} << 8 : 0u) |
                                   (count > 2 ? std::uint32_t{bytes[i + 2]} : 0u);
        text += digits[word >> 18];
        text += digits[word >> 12 & 63];
        text += count > 1 ? digits[word >> 6 & 63] : '=';
        text += count > 2 ? digits[word & 63] : '=';
    }
    return text;
}

} // namespace argand
