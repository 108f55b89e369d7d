// A session that makes one image after the other, and adds passes to them.
#include "moving_scene.hpp"
#include "rendering.hpp"
#include "world/world.hpp"

namespace argand::testing {
namespace {

bool go_on(double /*share*/) { return true; }

class Sessions : public EveryMethod {
protected:
    RenderSettings settings() const {
        RenderSettings settings = settings_of(GetParam(), 16, 4);
        settings.photons = 6'000;
        settings.photons_per_pass = 3'000;
        return settings;
    }
};

TEST_P(Sessions, EveryFrameHasThePictureOfAFreshRender) {
    Scene scene = moving_scene();
    World world(device(), scene);
    Session session(world, scene, settings());
    std::uint32_t seed = 0;
    for (const double time : {0.0, 0.25, 1.0, 0.0}) {
        move_to(time, scene);
        world.update(scene);
        RenderSettings fresh = settings();
        fresh.seed = seed++ % 3;
        session.begin_frame(fresh.seed);
        const RenderResult frame = finish(session, go_on), expected = render(scene, fresh);
        EXPECT_TRUE(same_bits(frame, expected)) << time;
        EXPECT_EQ(frame.statistics.samples, expected.statistics.samples);
        EXPECT_EQ(frame.statistics.photons_emitted, expected.statistics.photons_emitted);
        EXPECT_EQ(frame.statistics.photons_stored, expected.statistics.photons_stored);
        EXPECT_EQ(frame.statistics.flux.emitted, expected.statistics.flux.emitted);
    }
}

TEST_P(Sessions, FollowAScenesLightsThatComeAndGo) {
    // What the scene requires changes from frame to frame: direct light, a map, several lights.
    Scene scene = moving_scene();
    const std::vector<Light> lights = scene.lights;
    scene.motion.lights.clear();
    World world(device(), scene);
    Session session(world, scene, settings());
    for (const std::size_t count : {lights.size(), std::size_t(0), std::size_t(1), lights.size()}) {
        scene.lights.assign(lights.begin(), lights.begin() + static_cast<std::ptrdiff_t>(count));
        session.begin_frame(0);
        EXPECT_TRUE(same_bits(finish(session, go_on), render(scene, settings()))) << count;
    }
}

TEST_P(Sessions, PassesMayBeAddedOneByOne) {
    const Scene scene = load_asset("cornell_glass.glb");
    World world(device(), scene);
    Session session(world, scene, settings());
    session.begin_frame(0);
    std::uint64_t passes = 0;
    while (const std::optional<PassPlan> plan = session.next_pass()) {
        EXPECT_EQ(session.passes(), passes++);
        session.layers(); // looking at the image changes nothing
        EXPECT_TRUE(session.step(*plan, go_on));
    }
    EXPECT_EQ(session.passes(), passes);
    EXPECT_FALSE(session.next_pass());
    EXPECT_TRUE(same_bits(session.result(), render(scene, settings())));
}

INSTANTIATE_METHODS(Sessions);

} // namespace
} // namespace argand::testing
