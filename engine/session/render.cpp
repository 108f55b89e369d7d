#include "session/render.hpp"

#include "world/world.hpp"

namespace argand {

RenderResult finish(Session& session, const OnProgress& on_progress, const OnPass& on_pass) {
    const auto next = [&] {
        return on_pass ? on_pass({session.passes(), [&] { return session.layers(); }})
                       : session.next_pass();
    };
    while (const std::optional<PassPlan> plan = next()) {
        const bool finished = session.step(*plan, [&](double part) {
            return on_progress(on_pass
                                   ? (static_cast<double>(session.passes()) + part) / plan->expected
                                   : session.share(part));
        });
        if (!finished) {
            break;
        }
    }
    return session.result();
}

RenderResult render(World& world, const Scene& scene, const RenderSettings& settings,
                    const OnProgress& on_progress, const OnPass& on_pass, MethodTable methods) {
    Session session(world, scene, settings, methods);
    session.begin_frame(settings.seed);
    return finish(session, on_progress, on_pass);
}

RenderResult render(Device& device, const Scene& scene, const RenderSettings& settings,
                    const OnProgress& on_progress, const OnPass& on_pass, MethodTable methods) {
    World world(device, scene);
    return render(world, scene, settings, on_progress, on_pass, methods);
}

} // namespace argand
