#pragma once

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace argand {

/// The decimal number that is all of the text; nothing if it is not one that T holds.
template <class T> std::optional<T> parse_number(std::string_view text) {
    T number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(number)
                                                                    : std::nullopt;
}

/// Accepts decimal integers in [low, high]. Anything else is a usage error that names the range.
CLI::Validator integer_between(std::uint64_t low, std::uint64_t high);

/// Accepts decimal numbers in [low, high], so neither not-a-number nor infinity.
CLI::Validator number_between(double low, double high);

/// The same, and `auto`.
CLI::Validator or_auto(const CLI::Validator& accepted);

} // namespace argand
