#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>

namespace argand {

/// The index of the first element of that name, else the index that `choice` is. None: there is no
/// such element.
template <class Range>
std::optional<std::size_t> find_named(const Range& range, std::string_view choice) {
    std::size_t index = 0;
    for (const auto& element : range) {
        if (element.name == choice) {
            return index;
        }
        ++index;
    }
    std::size_t number = 0;
    const char* end = choice.data() + choice.size();
    const auto [read, error] = std::from_chars(choice.data(), end, number);
    return error == std::errc() && read == end && number < index ? std::optional(number)
                                                                 : std::nullopt;
}

} // namespace argand
