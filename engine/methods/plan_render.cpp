#include "methods/plan_render.hpp"

#include "methods/method_info.hpp"

#include <algorithm>
#include <initializer_list>

namespace argand {

namespace {

PlanRequest request_of(const RenderSettings& settings, MethodTable methods) {
    const MethodInfo& method = methods.at(settings.method);
    const Abilities& abilities = method.abilities;
    return {.follow_roughness = settings.follow_roughness,
            .cull_back_faces = settings.cull_back_faces,
            .photon_map = abilities.photon_map,
            .light_paths = abilities.light_paths,
            .footprints =
                method.wants_footprints ? method.wants_footprints(settings) : abilities.footprints,
            .cube_maps = abilities.approximate_hits,
            .final_gather = settings.final_gather,
            .everything = settings.everything};
}

/// Whether the scene has caustics at any time, of which this method would need photons: one method
/// serves for all frames of a film, and for --at.
bool may_have_caustics(const Scene& scene, RenderSettings settings, const MethodInfo& method,
                       MethodTable methods) {
    settings.method = method.name;
    PlanRequest request = request_of(settings, methods);
    request.at_any_time = true;
    return make_plan(scene, request).needs(Feature::caustics);
}

} // namespace

Plan plan_render(const Scene& scene, const RenderSettings& settings, MethodTable methods) {
    return make_plan(scene, request_of(settings, methods));
}

Plan plan_render(const Scene& scene, const SurfaceUse& use, const RenderSettings& settings,
                 MethodTable methods) {
    return make_plan(scene, use, request_of(settings, methods));
}

const MethodInfo& method_for(const Scene& scene, const RenderSettings& settings,
                             MethodTable methods) {
    const MethodInfo* first = methods.begin();
    const MethodInfo* other = methods.tried_first();
    if (!other) {
        return *first;
    }
    return may_have_caustics(scene, settings, *other, methods) ? *first : *other;
}

const MethodInfo* reference_method(const Scene& scene, const RenderSettings& settings,
                                   MethodTable methods) {
    const MethodInfo* first = methods.unbiased();
    const MethodInfo* connects =
        std::find_if(methods.begin(), methods.end(), [](const MethodInfo& method) {
            return method.abilities.unbiased && method.abilities.light_paths;
        });
    return first != nullptr && connects != methods.end() &&
                   may_have_caustics(scene, settings, *connects, methods)
               ? connects
               : first;
}

bool is_blind_to_caustics(const Scene& scene) {
    const Plan plan = make_plan(scene, {});
    const auto needs_any = [&](std::initializer_list<Feature> features) {
        return std::any_of(features.begin(), features.end(),
                           [&](Feature feature) { return plan.needs(feature); });
    };
    return needs_any({Feature::point_light, Feature::spot_light, Feature::directional_light}) &&
           needs_any({Feature::mirror, Feature::transmission});
}

} // namespace argand
