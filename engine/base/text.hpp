#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace argand {

/// Converts text to one line of valid UTF-8 that is safe to print: control characters and runs of
/// white space become one space, bytes that are not UTF-8 become '?', both ends are trimmed, and a
/// line longer than `limit` bytes is truncated and ends in "...".
std::string one_line(std::string_view text, std::size_t limit = 300);

} // namespace argand
