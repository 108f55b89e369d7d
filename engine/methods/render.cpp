#include "methods/render.hpp"

#include "base/error.hpp"
#include "methods/methods.hpp"

#include <algorithm>

namespace argand {

namespace {

struct NamedMethod {
    const char* name;
    Method method;
};

constexpr NamedMethod methods[] = {{"footprints", render_footprints},
                                   {"photons", render_photons},
                                   {"knn", render_nearest},
                                   {"path", render_path}};

} // namespace

std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const NamedMethod& named : methods) {
        names.emplace_back(named.name);
    }
    return names;
}

Plan plan_render(const Scene& scene, const RenderSettings& settings) {
    return make_plan(scene, {.follow_roughness = settings.follow_roughness,
                             .photon_map = settings.method != "path",
                             .footprints = settings.method == "footprints",
                             .final_gather = settings.final_gather,
                             .everything = settings.everything});
}

RenderResult render(Device& device, const Scene& scene, const RenderSettings& settings,
                    const OnProgress& progress, const OnPass& on_pass) {
    const auto named =
        std::find_if(std::begin(methods), std::end(methods),
                     [&](const NamedMethod& m) { return settings.method == m.name; });
    if (named == std::end(methods)) {
        throw UsageError(fmt::format("rendering '{}': there is no method '{}'; choose from {}",
                                     scene.name, settings.method, fmt::join(method_names(), ", ")));
    }
    return named->method(device, scene, settings, {progress, on_pass});
}

} // namespace argand
