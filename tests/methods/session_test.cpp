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

    void expect_frames_of_fresh_renders(Scene scene) {
        World world(device(), scene);
        std::optional<Session> session(std::in_place, world, scene, settings());
        std::uint32_t seed = 0;
        for (const double time : {0.0, 0.25, 1.0, 0.0}) {
            if (keeps_photons(GetParam())) {
                session.emplace(world, scene, settings());
            }
            move_to(time, scene);
            world.update(scene);
            RenderSettings fresh = settings();
            fresh.seed = seed++ % 3;
            session->begin_frame(fresh.seed);
            const RenderResult frame = finish(*session, go_on), expected = render(scene, fresh);
            EXPECT_TRUE(same_bits(frame, expected)) << time;
            EXPECT_EQ(frame.statistics.samples, expected.statistics.samples);
            EXPECT_EQ(frame.statistics.photons_emitted, expected.statistics.photons_emitted);
            EXPECT_EQ(frame.statistics.photons_stored, expected.statistics.photons_stored);
            EXPECT_EQ(frame.statistics.flux.emitted, expected.statistics.flux.emitted);
        }
    }

    /// Resumes a render of eight passes after some of them, and compares the next pass.
    void expect_same_bits_after_resuming(const Scene& scene) {
        SCOPED_TRACE(scene.name);
        RenderSettings long_render = settings();
        long_render.width = long_render.height = 12;
        long_render.samples = 16;
        long_render.samples_per_pass = 2; // eight passes
        long_render.photons_per_pass = 500;
        long_render.photons = 4'000;
        long_render.least_passes = keeps_photons(GetParam()) ? 8 : 1;
        World world(device(), scene);
        Session session(world, scene, long_render);
        session.begin_frame(long_render.seed);
        std::map<std::uint64_t, std::vector<std::uint8_t>> states; // by passes
        std::map<std::uint64_t, RenderResult> results;
        while (const std::optional<PassPlan> plan = session.next_pass()) {
            EXPECT_TRUE(session.step(*plan, go_on));
            states[session.passes()] = session.save();
            results[session.passes()] = session.result();
        }
        ASSERT_EQ(session.passes(), 8u);
        EXPECT_TRUE(same_bits(results[8], render(scene, long_render)));
        Session other(world, scene, long_render);
        other.begin_frame(5);
        EXPECT_TRUE(other.step({}, go_on)); // something to be replaced
        for (const std::uint64_t passes : {1, 2, 7}) {
            other.resume(states[passes], long_render.seed);
            EXPECT_EQ(other.passes(), passes);
            EXPECT_TRUE(same_bits(other.layers(), results[passes].layers));
            EXPECT_TRUE(other.step(other.next_pass().value(), go_on));
            const RenderResult next = other.result(), &expected = results[passes + 1];
            EXPECT_TRUE(same_bits(next, expected)) << passes;
            EXPECT_EQ(next.statistics.photons_stored, expected.statistics.photons_stored);
            EXPECT_EQ(next.statistics.flux.absorbed, expected.statistics.flux.absorbed);
            EXPECT_EQ(next.statistics.radius, expected.statistics.radius);
        }
        EXPECT_FALSE(other.next_pass());
    }
};

TEST_P(Sessions, EveryFrameHasThePictureOfAFreshRender) {
    expect_frames_of_fresh_renders(moving_scene());
}

TEST_P(Sessions, EveryFrameHasTheLightsAndMaterialsOfItsTime) {
    expect_frames_of_fresh_renders(changing_scene());
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

TEST_P(Sessions, KnowWhetherTheirImageIsThatOfTheSceneAsItIs) {
    Scene scene = moving_scene();
    World world(device(), scene);
    Session session(world, scene, settings());
    const auto is_current = [&] {
        world.update(scene);
        return session.is_current(0);
    };
    const auto render_frame = [&] {
        session.begin_frame(0);
        return finish(session, go_on);
    };
    EXPECT_FALSE(is_current());
    session.begin_frame(0);
    EXPECT_FALSE(is_current()); // without a pass
    const RenderResult image = finish(session, go_on);
    EXPECT_TRUE(is_current());
    EXPECT_FALSE(session.is_current(1));
    EXPECT_TRUE(same_bits(finish(session, go_on), image)); // no more passes
    scene.lights.back().intensity *= 2.0f;
    EXPECT_FALSE(is_current());
    render_frame();
    EXPECT_TRUE(is_current());
    scene.cameras[0].position.x += 0.01f;
    EXPECT_FALSE(is_current());
    render_frame();
    scene.materials[0].base_color = glm::vec3(0.25f);
    EXPECT_FALSE(is_current());
    render_frame();
    move_to(0.5, scene);
    EXPECT_FALSE(is_current());
    for (int i = 0; i < (keeps_photons(GetParam()) ? 10 : 1); ++i) {
        render_frame();
    }
    EXPECT_TRUE(is_current());
    session.step({}, go_on); // a pass more than the settings request
    EXPECT_FALSE(is_current());
    // An image of several moments, or of a part of its passes, is that of no moment.
    session.begin_frame(0);
    session.step({}, go_on);
    session.follow();
    finish(session, go_on);
    EXPECT_FALSE(is_current());
    session.begin_frame(0);
    session.step({}, [](double) { return false; });
    session.next_pass();
    EXPECT_FALSE(is_current());
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

// Of these scenes different things are learnt: where the sun comes in, how lights are chosen, where
// areas are sampled, at which small caster photons are aimed, whether eye paths follow near light.
TEST_P(Sessions, GoOnFromWhatTheyHaveSavedWithTheSameBits) {
    expect_same_bits_after_resuming(load_asset("window_room.glb"));
}

TEST_P(Sessions, SlowGoOnFromWhatTheyHaveSavedWithTheSameBits) {
    for (const char* name : {"sunlit_ground.glb", "marble_box.glb"}) {
        expect_same_bits_after_resuming(load_asset(name));
    }
    expect_same_bits_after_resuming(room_with_sheets());
}

class SessionsInParts : public Sessions {};

// Passes of a photon map that serves many samples: 48 x 48 pixels of which eight samples are traced
// together.
TEST_P(SessionsInParts, PartsOfAMapsSamplesHaveTheBitsOfAllAtOnce) {
    Device& device = open_anew({.limit = "storage_range=1MiB"});
    const Scene scene = load_asset("cornell_glass.glb");
    World world(device, scene);
    RenderSettings whole = settings();
    whole.width = whole.height = 48;
    whole.samples = 42; // 21 for each map
    RenderSettings parts = whole;
    parts.samples_per_pass = 9;
    const RenderResult expected = argand::render(world, scene, whole, [](double) { return true; });
    Session session(world, scene, parts), other(world, scene, parts);
    session.begin_frame(0);
    std::uint64_t parts_made = 0;
    while (const std::optional<PassPlan> plan = session.next_pass()) {
        ASSERT_TRUE(session.step(*plan, go_on));
        ++parts_made;
        if (parts_made == 2 || parts_made == 5) { // within a map's samples
            const std::vector<std::uint8_t> state = session.save();
            other.resume(state, 0);
            const RenderResult resumed = finish(other, go_on);
            EXPECT_TRUE(same_bits(resumed, expected)) << parts_made;
            EXPECT_EQ(resumed.statistics.photons_stored, expected.statistics.photons_stored);
            EXPECT_EQ(resumed.statistics.flux.absorbed, expected.statistics.flux.absorbed);
        }
    }
    const RenderResult result = session.result();
    EXPECT_TRUE(same_bits(result, expected));
    EXPECT_EQ(result.statistics.photons_emitted, expected.statistics.photons_emitted);
    EXPECT_EQ(result.statistics.flux.absorbed, expected.statistics.flux.absorbed);
    // Three parts of each of two maps. A queue has one map. `path` has none.
    const bool progressive = builtin_methods().at(GetParam()).abilities.progressive;
    const bool one_map = keeps_photons(GetParam());
    EXPECT_EQ(parts_made, progressive ? 2u : one_map ? 6u : GetParam() == "path" ? 5u : 6u);
    // Passes whose variance counts are alike, and those of an open shutter have moments of their
    // own.
    const auto passes_of = [&](const RenderSettings& of) {
        Session undivided(world, scene, of);
        undivided.begin_frame(0);
        return finish(undivided, go_on).statistics.passes;
    };
    parts.variance = true;
    EXPECT_EQ(passes_of(parts), GetParam() == "path" ? 5u : one_map ? 1u : 2u);
    parts.variance = false;
    parts.least_passes = 2;
    EXPECT_EQ(passes_of(parts), GetParam() == "path" ? 5u : 2u);
}

// A film in which lights and meshes move: photons that are kept from frame to frame have lights and
// paths.
TEST_P(Sessions, GoOnFromAFrameOfAFilmWithTheSameBits) {
    Scene scene = moving_scene();
    World world(device(), scene);
    Session session(world, scene, settings());
    for (const double time : {0.0, 0.02, 0.04}) {
        move_to(time, scene);
        world.update(scene);
        session.begin_frame(0);
        EXPECT_TRUE(session.step({}, go_on));
    }
    const std::vector<std::uint8_t> state = session.save();
    Session other(world, scene, settings());
    other.resume(state, 0);
    const auto next = [](Session& from) {
        EXPECT_TRUE(from.step({}, go_on));
        return from.result();
    };
    EXPECT_TRUE(same_bits(next(other), next(session)));
    // And the frame after it.
    move_to(0.06, scene);
    world.update(scene);
    const auto next_frame = [&](Session& from) {
        from.begin_frame(0);
        return next(from);
    };
    EXPECT_TRUE(same_bits(next_frame(other), next_frame(session)));
    for (std::size_t length = 0; length < state.size(); length += 1 + length / 2) {
        EXPECT_THROW(other.resume(std::span(state).first(length), 0), Error) << length;
    }
}

TEST_P(Sessions, RefuseStatesThatAreCutShortOrTooLong) {
    const Scene scene = moving_scene();
    World world(device(), scene);
    Session session(world, scene, settings());
    session.begin_frame(0);
    EXPECT_TRUE(session.step({}, go_on));
    std::vector<std::uint8_t> state = session.save();
    for (std::size_t length = 0; length < state.size(); length += 1 + length / 2) {
        EXPECT_THROW(session.resume(std::span(state).first(length), 0), Error) << length;
    }
    state.push_back(0);
    EXPECT_THROW(session.resume(state, 0), Error);
    state.pop_back();
    session.resume(state, 0);
    EXPECT_EQ(session.passes(), 1u);
}

INSTANTIATE_METHODS(Sessions);
// Each pass of `bidirectional` has light paths of its own, which its parts do not share.
INSTANTIATE_QUICK_AND_SLOW(SessionsInParts, "footprints", without(method_names(), "bidirectional"));

TEST(ArchiveTest, LoadsWhatItHasSaved) {
    double number = 0.1;
    std::vector<std::uint32_t> list{3, 1, 4};
    std::string text("a\0b", 3);
    Archive saving;
    saving.value(number);
    saving.values(list);
    saving.text(text);
    bool flag = true;
    std::optional<float> some = 2.5f, none;
    saving.flag(flag);
    saving.optional(some);
    saving.optional(none);
    const std::vector<std::uint8_t> bytes = std::move(saving).take_bytes();
    Archive loading(bytes);
    double other = 0;
    std::vector<std::uint32_t> other_list{9};
    std::string other_text;
    loading.value(other);
    EXPECT_FALSE(loading.at_end());
    loading.values(other_list);
    loading.text(other_text);
    bool other_flag = false;
    std::optional<float> other_some, other_none = 1.0f;
    loading.flag(other_flag);
    loading.optional(other_some);
    loading.optional(other_none);
    EXPECT_TRUE(other_flag);
    EXPECT_EQ(other_some, some);
    EXPECT_EQ(other_none, none);
    EXPECT_EQ(other, number);
    EXPECT_EQ(other_list, list);
    EXPECT_EQ(other_text, text);
    EXPECT_TRUE(loading.at_end());
    EXPECT_THROW(loading.value(other), Error);
}

TEST(ArchiveTest, RefusesCountsThatExceedItsBytes) {
    std::uint64_t count = ~std::uint64_t(0) / 8 + 2; // times 8 it would wrap around to 8
    Archive saving;
    saving.value(count);
    saving.value(count);
    const std::vector<std::uint8_t> bytes = std::move(saving).take_bytes();
    Archive loading(bytes);
    std::vector<std::uint64_t> list;
    EXPECT_THROW(loading.values(list), Error);
}

} // namespace
} // namespace argand::testing
