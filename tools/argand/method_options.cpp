#include "method_options.hpp"

#include "base/error.hpp"
#include "numbers.hpp"

#include <algorithm>
#include <fmt/ranges.h>

namespace argand {

namespace {

const char* type_name(OptionKind kind) {
    switch (kind) {
    case OptionKind::integer:
        return "UINT";
    case OptionKind::number:
        return "FLOAT";
    default:
        return "TEXT";
    }
}

CLI::Validator accepted_values(const Option& option) {
    switch (option.kind) {
    case OptionKind::integer:
        return integer_between(static_cast<std::uint64_t>(option.low),
                               static_cast<std::uint64_t>(option.high));
    case OptionKind::number:
        return number_between(option.low, option.high);
    default:
        return CLI::IsMember(option.choices);
    }
}

void add_option(CLI::App& command, RenderSettings& settings, const Option& option) {
    const std::string name = "--" + option.name;
    if (option.kind == OptionKind::flag) {
        command.add_flag_callback(
            name, [&settings, set = option.set] { set(settings, "on"); }, option.help);
        return;
    }
    CLI::Option* added = command.add_option_function<std::string>(
        name, [&settings, set = option.set](const std::string& value) { set(settings, value); },
        option.help);
    added->type_name(type_name(option.kind));
    const std::string initially = option.get(settings);
    const CLI::Validator accepted = accepted_values(option);
    const bool accepts_auto =
        std::find(option.choices.begin(), option.choices.end(), "auto") != option.choices.end();
    added->check(initially == "auto" && !accepts_auto ? or_auto(accepted) : accepted);
    if (initially != "auto") {
        added->default_str(initially);
    }
}

} // namespace

void add_method_options(CLI::App& command, RenderSettings& settings, MethodTable methods) {
    std::vector<const Option*> alone;
    for (const Option* option : methods.options()) {
        if (methods.users_of(option->name).size() > 1) {
            add_option(command, settings, *option);
        } else {
            alone.push_back(option);
        }
    }
    for (const MethodInfo& method : methods) {
        CLI::App* group = nullptr;
        for (const Option* option : alone) {
            if (method.option(option->name)) {
                group = group ? group : command.add_option_group("Method " + method.name);
                add_option(*group, settings, *option);
            }
        }
    }
}

std::string describe_methods(MethodTable methods) {
    std::size_t width = 0;
    for (const MethodInfo& method : methods) {
        width = std::max(width, method.name.size());
    }
    std::string text = "Methods:";
    for (const MethodInfo& method : methods) {
        text += fmt::format("\n  {:<{}} {} ({})", method.name, width, method.summary, method.paper);
    }
    return text;
}

bool is_given(const CLI::App& command, const std::string& option) {
    const CLI::Option* found = command.get_option_no_throw(option);
    return found && found->count() > 0;
}

void check_methods(const std::vector<std::string>& names, MethodTable methods) {
    for (const std::string& name : names) {
        methods.at(name);
    }
}

void check_method_options(const CLI::App& command, const MethodInfo& method, MethodTable methods) {
    for (const Option* option : methods.options()) {
        if (!method.option(option->name) && is_given(command, "--" + option->name)) {
            throw UsageError(fmt::format(
                "reading --{}: it has no effect with --method {}; it is for {}; leave it out",
                option->name, method.name, fmt::join(methods.users_of(option->name), ", ")));
        }
    }
}

} // namespace argand
