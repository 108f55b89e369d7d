#include "methods/render.hpp"

#include "base/error.hpp"
#include "methods/light_learning.hpp"
#include "methods/method.hpp"
#include "methods/next_pass.hpp"
#include "world/world.hpp"

namespace argand {

namespace {

RenderContext make_context(World& world, const Scene& scene, const RenderSettings& settings,
                           MethodTable methods) {
    RenderContext context{.device = world.device(),
                          .scene = scene,
                          .settings = settings,
                          .on_device =
                              world.on_device(scene, plan_render(scene, settings, methods)),
                          .eye = {}};
    context.eye = make_eye_workspace(
        context.device, context.on_device.plan, settings,
        camera_record(scene.cameras[settings.camera], settings.width, settings.height));
    learn_lights(context);
    return context;
}

/// Adds passes to the film until the listeners, the budget, the random numbers or the method's
/// number of passes end it.
void run_passes(Method& method, const RenderContext& context, Budget& budget,
                const Listeners& listeners, RenderStatistics& statistics) {
    const auto plan_next = [&] {
        const auto layers = [&] {
            return resolve_film(context.device, context.eye.film, statistics);
        };
        return next_pass(listeners, budget, {statistics.passes, layers}, method.passes());
    };
    Streams streams(context.settings.seed);
    std::optional<PassPlan> plan = plan_next();
    while (plan) {
        const Pass pass{.expected = plan->expected, .numbers = streams.next(plan->stream)};
        const bool finished = method.pass(pass, [&](double part) {
            return tell_progress(listeners, budget, *plan, statistics.passes, part,
                                 method.passes());
        });
        ++statistics.passes;
        statistics.interrupted = !finished;
        plan = finished && method.has_numbers(pass.numbers.index + 1) ? plan_next() : std::nullopt;
    }
}

} // namespace

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

RenderResult render(World& world, const Scene& scene, const RenderSettings& settings,
                    const OnProgress& progress, const OnPass& on_pass, MethodTable methods) {
    const MethodInfo& info = methods.at(settings.method);
    Budget budget(settings.budget);
    RenderContext context = make_context(world, scene, settings, methods);
    const std::unique_ptr<Method> method = info.make(context);
    method->begin(budget);
    RenderResult result;
    run_passes(*method, context, budget, {progress, on_pass}, result.statistics);
    method->report(result.statistics);
    result.layers = resolve_film(context.device, context.eye.film, result.statistics);
    return result;
}

RenderResult render(Device& device, const Scene& scene, const RenderSettings& settings,
                    const OnProgress& progress, const OnPass& on_pass, MethodTable methods) {
    World world(device, scene);
    return render(world, scene, settings, progress, on_pass, methods);
}

} // namespace argand
