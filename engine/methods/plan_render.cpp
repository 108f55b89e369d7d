#include "methods/plan_render.hpp"

#include "methods/method_info.hpp"

namespace argand {

namespace {

PlanRequest request_of(const RenderSettings& settings, MethodTable methods) {
    const MethodInfo& method = methods.at(settings.method);
    const Abilities& abilities = method.abilities;
    return {.follow_roughness = settings.follow_roughness,
            .cull_back_faces = settings.cull_back_faces,
            .photon_map = abilities.photon_map,
            .footprints =
                method.wants_footprints ? method.wants_footprints(settings) : abilities.footprints,
            .cube_maps = abilities.approximate_hits,
            .final_gather = settings.final_gather,
            .everything = settings.everything};
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
    RenderSettings by_other = settings;
    by_other.method = other->name;
    PlanRequest request = request_of(by_other, methods);
    request.at_any_time = true; // one method for all frames of a film, and for --at
    return make_plan(scene, request).needs(Feature::caustics) ? *first : *other;
}

} // namespace argand
