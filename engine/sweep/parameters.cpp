#include "sweep/parameters.hpp"

#include <fmt/format.h>

namespace argand {

namespace {

std::string flag(bool on) { return on ? "on" : "off"; }

template <class T> std::string or_auto(const std::optional<T>& value) {
    return value ? fmt::format("{}", *value) : "auto";
}

void append_footprints(std::vector<Parameter>& list, const FootprintSettings& settings) {
    list.insert(list.end(), {{"smoothing", or_auto(settings.smoothing)},
                             {"caustic-smoothing", fmt::format("{}", settings.caustic_smoothing)},
                             {"max-footprint", or_auto(settings.largest)},
                             {"flatness", fmt::format("{}", settings.flatness)},
                             {"uniform-kernel", flag(settings.uniform_kernel)},
                             {"fixed-smoothing", flag(settings.fixed_smoothing)},
                             {"paper-axes", flag(settings.paper_axes)},
                             {"paper-reemission", flag(settings.paper_reemission)}});
}

} // namespace

std::vector<Parameter> parameters(const RenderSettings& settings) {
    const bool limited = settings.bounces != RenderSettings().bounces;
    std::vector<Parameter> list{{"method", settings.method},
                                {"spp", fmt::format("{}", settings.samples)},
                                {"bounces", limited ? fmt::format("{}", settings.bounces) : "auto"},
                                {"follow-roughness", fmt::format("{}", settings.follow_roughness)}};
    if (settings.method == "path") {
        return list;
    }
    list.insert(list.end(), {{"photons", fmt::format("{}", settings.photons)},
                             {"radius", or_auto(settings.radius)},
                             {"query-cell", fmt::format("{}", settings.query_cell)},
                             {"leaf-size", fmt::format("{}", settings.footprints.leaf_size)},
                             {"wide-codes", flag(settings.wide_codes)},
                             {"photon-sampling",
                              settings.photon_sampling == Sampling::sobol ? "sobol" : "random"},
                             {"final-gather", flag(settings.final_gather)}});
    if (settings.method == "knn") {
        list.emplace_back("k", or_auto(settings.neighbours));
    }
    if (settings.method == "footprints") {
        append_footprints(list, settings.footprints);
    }
    return list;
}

std::string parameter_key(const RenderSettings& settings) {
    std::string key;
    for (const auto& [name, value] : parameters(settings)) {
        key += fmt::format("{}{}={}", key.empty() ? "" : " ", name, value);
    }
    return key;
}

std::string command_options(const RenderSettings& settings) {
    RenderSettings defaults;
    defaults.method = settings.method;
    const std::vector<Parameter> usual = parameters(defaults);
    const std::vector<Parameter> asked = parameters(settings);
    std::string options = "--method " + settings.method;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const auto& [name, value] = asked[i];
        if (value != usual[i].second) {
            options += " --" + name + (value == "on" ? "" : " " + value);
        }
    }
    return options;
}

} // namespace argand
