#include "numbers.hpp"

#include <charconv>
#include <fmt/format.h>

namespace argand {

namespace {

// CLI11's own ranges accept NaN, and report text that is no number without the range.
template <class T> CLI::Validator between(T low, T high, const char* what) {
    const std::string range = fmt::format("from {} to {}", low, high);
    return CLI::Validator(
        [=](const std::string& text) -> std::string {
            T value{};
            const char* begin =
                text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
            const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
            // Written so that NaN fails.
            if (error == std::errc() && end == text.data() + text.size() && value >= low &&
                value <= high) {
                return "";
            }
            return fmt::format("'{}' is not {} {}", text, what, range);
        },
        range);
}

} // namespace

CLI::Validator integer_between(std::uint64_t low, std::uint64_t high) {
    return between(low, high, "an integer");
}

CLI::Validator number_between(double low, double high) { return between(low, high, "a number"); }

CLI::Validator or_auto(const CLI::Validator& accepted) {
    return CLI::Validator(
        [accepted](std::string& text) { return text == "auto" ? std::string() : accepted(text); },
        accepted.get_description() + ", or auto");
}

} // namespace argand
