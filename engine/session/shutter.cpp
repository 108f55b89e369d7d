#include "session/shutter.hpp"

#include "scene/pose.hpp"
#include "shared/random.h"
#include "shared/sobol.h"
#include "world/world.hpp"

#include <cmath>

namespace argand {

double moment_of(const Shutter& shutter, std::uint64_t pass, std::uint32_t seed) {
    const std::uint32_t scramble = pcg4d({seed, 0x5b077e5u, 0, 0}).x;
    const std::uint32_t fraction =
        reverse_bits(owen_scramble_reversed(static_cast<std::uint32_t>(pass), scramble));
    const double share = std::ldexp(static_cast<double>(fraction) + 0.5, -32);
    return shutter.open + share * (shutter.close - shutter.open);
}

RenderSettings with_pass_per_sample(RenderSettings settings) {
    settings.least_passes = settings.samples;
    return settings;
}

RenderResult render_through(Session& session, World& world, Scene& scene, const Shutter& shutter,
                            std::uint32_t seed, const OnProgress& on_progress) {
    const auto move = [&](std::uint64_t pass) {
        move_without_vertices(moment_of(shutter, pass, seed), scene);
        world.update(scene);
    };
    move(0);
    session.begin_frame(seed);
    return finish(session, on_progress, [&](const PictureSoFar& so_far) {
        const std::optional<PassPlan> plan = session.next_pass();
        if (plan && so_far.passes > 0) {
            move(so_far.passes);
            session.follow();
        }
        return plan;
    });
}

} // namespace argand
