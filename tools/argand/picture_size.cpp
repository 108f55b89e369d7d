#include "picture_size.hpp"

#include "base/error.hpp"
#include "numbers.hpp"

#include <algorithm>
#include <string_view>

namespace argand {

namespace {

constexpr int largest_side = 32768;

int parse_side(std::string_view text, const std::string& size) {
    const std::optional<int> side = parse_number<int>(text);
    if (!side || *side < 1 || *side > largest_side) {
        throw UsageError(fmt::format(
            "reading --size {}: it must be WIDTHxHEIGHT, each from 1 to {}", size, largest_side));
    }
    return *side;
}

} // namespace

PictureSize parse_picture_size(const std::string& size) {
    const std::size_t x = std::min(size.find('x'), size.size());
    return {parse_side(std::string_view(size).substr(0, x), size),
            parse_side(std::string_view(size).substr(std::min(x + 1, size.size())), size)};
}

} // namespace argand
