#include "methods/option.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

namespace argand {

namespace {

template <class T> void read_number(const std::string& option, const std::string& text, T& value) {
    const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || last != end) {
        throw UsageError(fmt::format("reading --{}: '{}' is no value of it", option, text));
    }
}

} // namespace

std::string value_text(bool value) { return value ? "on" : "off"; }
std::string value_text(std::uint32_t value) { return fmt::format("{}", value); }
std::string value_text(std::uint64_t value) { return fmt::format("{}", value); }
std::string value_text(float value) { return fmt::format("{}", value); }
std::string value_text(double value) { return fmt::format("{}", value); }

void read_value(const std::string& option, const std::string& text, bool& value) {
    if (text != "on" && text != "off") {
        throw UsageError(fmt::format("reading --{}: '{}' is neither on nor off", option, text));
    }
    value = text == "on";
}

void read_value(const std::string& option, const std::string& text, std::uint32_t& value) {
    read_number(option, text, value);
}

void read_value(const std::string& option, const std::string& text, std::uint64_t& value) {
    read_number(option, text, value);
}

void read_value(const std::string& option, const std::string& text, float& value) {
    read_number(option, text, value);
}

void read_value(const std::string& option, const std::string& text, double& value) {
    read_number(option, text, value);
}

std::string key_of(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

Option own_option(const std::string& name, const std::string& help, OptionKind kind,
                  const std::string& initially) {
    return {.name = name,
            .help = help,
            .kind = kind,
            .choices = {},
            .report_key = key_of(name),
            .get =
                [name, initially](const RenderSettings& settings) {
                    const auto found = settings.own.find(name);
                    return found == settings.own.end() ? initially : found->second;
                },
            .set = [name](RenderSettings& settings,
                          const std::string& text) { settings.own[name] = text; },
            .sweep = {}};
}

double own_number(const RenderSettings& settings, const Option& option) {
    double value = 0;
    read_value(option.name, option.get(settings), value);
    return value;
}

Option with_sweep(Option option, OptionSweep sweep) {
    option.sweep = std::move(sweep);
    return option;
}

} // namespace argand
