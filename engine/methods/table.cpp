#include "methods/table.hpp"

#include "base/error.hpp"
#include "methods/method_info.hpp"

#include <algorithm>
#include <array>
#include <fmt/ranges.h>

// The built-in methods, the default first. METHOD(name) needs a function `MethodInfo
// name_method()`, which stands in the file of the method.
#define ARGAND_METHODS(METHOD)                                                                     \
    METHOD(footprints)                                                                             \
    METHOD(photons)                                                                                \
    METHOD(knn)                                                                                    \
    METHOD(progressive)                                                                            \
    METHOD(photon_queue)                                                                           \
    METHOD(image_space)                                                                            \
    METHOD(path)                                                                                   \
    METHOD(bidirectional)

namespace argand {

#define DECLARE(name) MethodInfo name##_method();
ARGAND_METHODS(DECLARE)
#undef DECLARE

MethodTable builtin_methods() {
#define CALL(name) name##_method(),
    static const std::array methods{ARGAND_METHODS(CALL)};
#undef CALL
    return MethodTable(methods);
}

const MethodInfo* MethodTable::find(std::string_view name) const {
    const MethodInfo* found =
        std::find_if(begin(), end(), [&](const MethodInfo& method) { return method.name == name; });
    return found == end() ? nullptr : found;
}

const MethodInfo& MethodTable::at(std::string_view name) const {
    if (const MethodInfo* method = find(name)) {
        return *method;
    }
    throw UsageError(
        fmt::format("choosing method '{}': choose from {}", name, fmt::join(names(), ", ")));
}

const MethodInfo* MethodTable::unbiased() const {
    const MethodInfo* found = std::find_if(
        begin(), end(), [](const MethodInfo& method) { return method.abilities.unbiased; });
    return found == end() ? nullptr : found;
}

const MethodInfo* MethodTable::tried_first() const {
    const MethodInfo* found = std::find_if(
        begin(), end(), [](const MethodInfo& method) { return method.trial == TrialOrder::first; });
    return found == end() ? nullptr : found;
}

std::vector<std::string> MethodTable::names() const {
    std::vector<std::string> names;
    for (const MethodInfo& method : *this) {
        names.push_back(method.name);
    }
    return names;
}

std::vector<const Option*> MethodTable::options() const {
    std::vector<const Option*> options;
    for (const MethodInfo& method : *this) {
        for (const Option& option : method.options) {
            const auto is_same = [&](const Option* known) { return known->name == option.name; };
            if (std::none_of(options.begin(), options.end(), is_same)) {
                options.push_back(&option);
            }
        }
    }
    return options;
}

std::vector<std::string> MethodTable::users_of(std::string_view option) const {
    std::vector<std::string> users;
    for (const MethodInfo& method : *this) {
        if (method.option(option)) {
            users.push_back(method.name);
        }
    }
    return users;
}

const Option* MethodInfo::option(std::string_view option_name) const {
    const auto found = std::find_if(options.begin(), options.end(), [&](const Option& option) {
        return option.name == option_name;
    });
    return found == options.end() ? nullptr : &*found;
}

bool is_progressive(const MethodInfo& method, const RenderSettings& settings) {
    return method.abilities.progressive || (method.abilities.photon_map && settings.progressive.on);
}

ErrorLaw law_of(const MethodInfo& method, const RenderSettings& settings) {
    return is_progressive(method, settings) ? progressive_law(settings.progressive.exponent)
                                            : method.law;
}

std::vector<std::string> method_names() { return builtin_methods().names(); }

std::string default_method() { return builtin_methods().begin()->name; }

} // namespace argand
