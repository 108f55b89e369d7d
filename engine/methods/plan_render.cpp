#include "methods/plan_render.hpp"

namespace argand {

Plan plan_render(const Scene& scene, const RenderSettings& settings, MethodTable methods) {
    const Abilities& abilities = methods.at(settings.method).abilities;
    return make_plan(scene, {.follow_roughness = settings.follow_roughness,
                             .photon_map = abilities.photon_map,
                             .footprints = abilities.footprints,
                             .final_gather = settings.final_gather,
                             .everything = settings.everything});
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
    return plan_render(scene, by_other, methods).needs(Feature::caustics) ? *first : *other;
}

} // namespace argand
