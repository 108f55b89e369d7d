#include "sweep/parameters.hpp"

#include "methods/method_info.hpp"

#include <fmt/format.h>

namespace argand {

std::vector<Parameter> parameters(const RenderSettings& settings, MethodTable methods) {
    std::vector<Parameter> list{{"method", settings.method}};
    for (const Option& option : methods.at(settings.method).options) {
        list.emplace_back(option.name, option.get(settings));
    }
    return list;
}

std::string parameter_key(const RenderSettings& settings, MethodTable methods) {
    std::string key;
    for (const auto& [name, value] : parameters(settings, methods)) {
        key += fmt::format("{}{}={}", key.empty() ? "" : " ", name, value);
    }
    return key;
}

std::string command_options(const RenderSettings& settings, MethodTable methods) {
    std::string options = "--method " + settings.method;
    for (const Option& option : methods.at(settings.method).options) {
        const std::string value = option.get(settings);
        if (value != option.get(RenderSettings())) {
            options += " --" + option.name;
            options += option.kind == OptionKind::flag ? "" : " " + value;
        }
    }
    return options;
}

} // namespace argand
