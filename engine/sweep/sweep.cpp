#include "sweep/sweep.hpp"

#include "methods/method_info.hpp"
#include "sweep/parameters.hpp"

#include <algorithm>
#include <set>

namespace argand {

namespace {

// Multiples of a bandwidth that a method chose, which a sweep tries.
constexpr double factors[] = {0.5, 2};

/// The values of one option to try.
std::vector<std::string> values_of(const Option& option, const RenderStatistics& learnt,
                                   Extent extent) {
    const OptionSweep& swept = option.sweep;
    std::vector<std::string> values = extent == Extent::full ? swept.full : swept.quick;
    for (const double factor : factors) {
        if (std::string value = swept.around ? swept.around(learnt, factor) : ""; !value.empty()) {
            values.push_back(std::move(value));
        }
    }
    return values;
}

/// The options of a method, those of a quick sweep first: an interrupted sweep has then tried the
/// ones that matter most.
std::vector<const Option*> by_importance(const MethodInfo& method) {
    std::vector<const Option*> options;
    for (const Option& option : method.options) {
        options.push_back(&option);
    }
    std::stable_partition(options.begin(), options.end(), [](const Option* option) {
        return !option->sweep.quick.empty() || option->sweep.around;
    });
    return options;
}

/// The base settings, and those with one option of the method changed at a time.
std::vector<Setting> sweep_method(const Scene& scene, const RenderSettings& base,
                                  const RenderStatistics& learnt, Extent extent,
                                  MethodTable methods) {
    const auto setting = [&](const std::string& option, const std::string& value,
                             const RenderSettings& settings) {
        return Setting{.option = option,
                       .value = value,
                       .key = parameter_key(settings, methods),
                       .options = command_options(settings, methods),
                       .render = settings};
    };
    std::vector<Setting> settings{setting("default", "", base)};
    const Plan plan = make_plan(scene, {.follow_roughness = base.follow_roughness});
    if (plan.light_kinds() == 0) {
        return settings;
    }
    std::set<std::string> seen{settings.front().key};
    for (const Option* option : by_importance(methods.at(base.method))) {
        for (const std::string& value : values_of(*option, learnt, extent)) {
            RenderSettings changed = base;
            option->set(changed, value);
            const Variation variation{
                .scene = scene, .plan = plan, .base = base, .changed = changed};
            if (option->sweep.matters && !option->sweep.matters(variation)) {
                continue;
            }
            Setting next = setting(option->name, option->get(changed), changed);
            if (seen.insert(next.key).second) {
                settings.push_back(std::move(next));
            }
        }
    }
    return settings;
}

} // namespace

std::vector<Setting> sweep(const Scene& scene, const RenderSettings& base,
                           const std::vector<std::string>& names, const LearntBandwidths& learnt,
                           Extent extent, MethodTable methods) {
    std::vector<Setting> all;
    std::set<std::string> seen;
    for (const std::string& name : names) {
        if (!seen.insert(name).second) {
            continue;
        }
        RenderSettings of_method = base;
        of_method.method = name;
        const auto found = learnt.find(name);
        const std::vector<Setting> some = sweep_method(
            scene, of_method, found == learnt.end() ? RenderStatistics() : found->second, extent,
            methods);
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

} // namespace argand
