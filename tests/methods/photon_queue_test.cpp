// The photons queue from frame to frame: what still and moving lights leave in it.
#include "methods/light_change.hpp"
#include "moving_scene.hpp"
#include "rendering.hpp"
#include "world/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace argand::testing {
namespace {

bool proceed_with_frame(double /*share*/) { return true; }

class PhotonQueueFrames : public RenderTest {
protected:
    static RenderSettings queue_settings(std::uint32_t window, bool fills = true) {
        RenderSettings settings = settings_of("photon-queue", 12, 4);
        settings.photons = 8'000;
        settings.own["window"] = std::to_string(window);
        settings.own["queue-fill"] = fills ? "all" : "gradual";
        // Other methods leave out what is not linked to the view. And where estimates are not taken
        // if they are uneven, rounding decides about some.
        settings.least_coverage = 0;
        return settings;
    }

    /// A room with one lamp.
    static Scene lit_room() {
        Scene scene = room_scene();
        scene.lights.resize(1);
        return scene;
    }

    static RenderResult frame(Session& session, std::uint32_t seed = 0) {
        session.begin_frame(seed);
        return finish(session, proceed_with_frame);
    }

    /// Expects layers that differ by rounding only.
    static void expect_equal_to_rounding(const RenderResult& found, const RenderResult& expected) {
        for (const char* name : {"direct", "indirect", "caustic"}) {
            const Image& a = layer(found, name);
            const Image& b = layer(expected, name);
            for (std::size_t i = 0; i < a.pixels.size(); ++i) {
                for (int c = 0; c < 3; ++c) {
                    ASSERT_NEAR(a.pixels[i][c], b.pixels[i][c], 2e-5 * b.pixels[i][c] + 1e-7)
                        << name << i;
                }
            }
        }
    }
};

TEST_F(PhotonQueueFrames, FullQueueIsTheMapOfAllItsPhotons) {
    const Scene scene = lit_room();
    World world(device(), scene);
    for (const std::uint32_t window : {1u, 4u, 64u}) {
        RenderSettings settings = queue_settings(window);
        settings.radius = 0.4;
        RenderSettings rebuilt = settings;
        rebuilt.method = "photons";
        const RenderResult expected = render(scene, rebuilt);
        expect_equal_to_rounding(render(scene, settings), expected);
        for (const char* tree : {"lbvh", "kdtree"}) {
            settings.own["rebuild"] = tree;
            expect_equal_to_rounding(render(scene, settings), expected);
        }
        // One block in each frame: after the last of the window, and long after.
        RenderSettings gradual = queue_settings(window, false);
        gradual.radius = 0.4;
        Session session(world, scene, gradual);
        for (std::uint32_t i = 1; i <= window; ++i) {
            const RenderResult result = frame(session);
            EXPECT_EQ(result.statistics.photons_emitted, 8'000 / window);
            EXPECT_EQ(session.is_current(0), i == window);
            if (i == window) {
                expect_equal_to_rounding(result, expected);
            }
        }
        expect_equal_to_rounding(frame(session), expected);
    }
}

TEST_F(PhotonQueueFrames, FindsTheNearestPhotonsOfAllBlocks) {
    RenderSettings settings = queue_settings(4);
    settings.own["estimator"] = "knn";
    settings.radius = 0.5;
    settings.neighbours = 60;
    RenderSettings rebuilt = settings;
    rebuilt.method = "knn";
    const RenderResult found = render(lit_room(), settings);
    expect_equal_to_rounding(found, render(lit_room(), rebuilt));
    EXPECT_EQ(found.statistics.neighbours, 60u);
}

TEST_F(PhotonQueueFrames, FindsTheFootprintsOfAllBlocks) {
    const Scene scene = lit_room();
    World world(device(), scene);
    RenderSettings rebuilt = queue_settings(4);
    rebuilt.radius = 0.4;
    rebuilt.footprints.smoothing = 0.3;
    rebuilt.method = "footprints";
    rebuilt.wide_codes =
        true; // no two photons have one code: area samples have the same neighbours
    const RenderResult expected = render(scene, rebuilt);
    for (const std::uint32_t window : {1u, 4u}) {
        RenderSettings settings = queue_settings(window);
        settings.radius = rebuilt.radius;
        settings.footprints = rebuilt.footprints;
        settings.own["estimator"] = "footprints";
        const RenderResult found = render(scene, settings);
        expect_equal_to_rounding(found, expected);
        EXPECT_EQ(found.statistics.smoothing, expected.statistics.smoothing);
        EXPECT_RELATIVE(found.statistics.mean_footprints, expected.statistics.mean_footprints,
                        1e-5);
        settings.own["rebuild"] = "kdtree";
        expect_equal_to_rounding(render(scene, settings), expected);
        // One block in each frame: when the window is full, and long after.
        settings.own["rebuild"] = "off";
        settings.own["queue-fill"] = "gradual";
        Session session(world, scene, settings);
        RenderResult last;
        for (std::uint32_t i = 0; i < window; ++i) {
            last = frame(session);
        }
        expect_equal_to_rounding(last, expected);
        expect_equal_to_rounding(frame(session), expected);
    }
}

TEST_F(PhotonQueueFrames, LearnsFootprintsAsLargeAsThoseOfTheMethod) {
    RenderSettings settings = queue_settings(4);
    settings.own["estimator"] = "footprints";
    RenderSettings rebuilt = settings;
    rebuilt.method = "footprints";
    const RenderResult found = render(lit_room(), settings);
    const RenderResult expected = render(lit_room(), rebuilt);
    EXPECT_RELATIVE(found.statistics.smoothing, expected.statistics.smoothing, 1e-6);
    EXPECT_RELATIVE(found.statistics.mean_footprints, expected.statistics.mean_footprints, 1e-4);
}

TEST_F(PhotonQueueFrames, FootprintsOfAMovingLightAreNotFarBehind) {
    Scene scene = lit_room();
    World world(device(), scene);
    RenderSettings settings = queue_settings(8);
    settings.photons = 80'000;
    settings.own["estimator"] = "footprints";
    Session session(world, scene, settings);
    const float end = scene.lights[0].position.x;
    for (int i = 8; i >= 0; --i) {
        scene.lights[0].position.x = end - 0.03f * static_cast<float>(i);
        frame(session);
    }
    scene.lights[0].position.x = end + 0.03f;
    const RenderResult moving = frame(session);
    EXPECT_EQ(moving.statistics.non_finite, 0u);
    const Image truth = layer(render(scene, settings), "");
    EXPECT_LT(compare(layer(moving, ""), truth).rel_mse, 0.02);
}

TEST_F(PhotonQueueFrames, CellsMayTestAllPhotons) {
    const Scene scene = lit_room();
    World world(device(), scene);
    RenderSettings settings = queue_settings(3);
    RenderSettings tests = settings;
    tests.own["classify"] = "leaves";
    Session session(world, scene, settings);
    Session other(world, scene, tests);
    for (int i = 0; i < 5; ++i) {
        EXPECT_TRUE(same_bits(frame(other), frame(session)));
    }
}

TEST_F(PhotonQueueFrames, PhotonsMayAccountForDirectLight) {
    for (const bool emitter : {false, true}) {
        const Scene scene = emitter ? load_asset("cornell_area.glb") : lit_room();
        RenderSettings settings = queue_settings(4);
        settings.photons = 60'000;
        settings.radius = emitter ? 0.06 : 0.25;
        const RenderResult expected = render(scene, settings);
        settings.own["direct"] = "photons";
        const RenderResult found = render(scene, settings);
        for (int c = 0; c < 3; ++c) {
            EXPECT_RELATIVE(mean(layer(found, ""))[c], mean(layer(expected, ""))[c], 0.04);
        }
        // What is left is the emission that the camera sees.
        EXPECT_LT(mean(layer(found, "direct")).x, mean(layer(expected, "direct")).x);
        EXPECT_EQ(mean(layer(found, "direct")).x > 0, emitter);
        EXPECT_EQ(mean(layer(found, "caustic")), glm::dvec3(0));
        settings.bounces = 0; // direct light alone
        EXPECT_RELATIVE(mean(layer(render(scene, settings), "")).y,
                        mean(layer(expected, "direct")).y, 0.05);
    }
}

TEST_F(PhotonQueueFrames, PhotonsMayBeShownAsPoints) {
    RenderSettings settings = queue_settings(4);
    settings.width = settings.height = 48;
    settings.own["show"] = "photons";
    std::size_t before = 0;
    for (const std::uint64_t photons : {0u, 100u, 1'000u}) {
        settings.photons = photons;
        const RenderResult result = render(lit_room(), settings);
        std::size_t lit = 0;
        for (const glm::vec3& pixel : layer(result, "").pixels) {
            const float most = std::max({pixel.r, pixel.g, pixel.b});
            ASSERT_TRUE(most == 0 || std::abs(most - 1) < 1e-6f);
            lit += most > 0 ? 1 : 0;
        }
        EXPECT_LE(lit, result.statistics.photons_stored);
        EXPECT_TRUE(photons == 0 ? lit == 0 : lit > 4 * before && lit > photons / 10) << lit;
        before = lit;
    }
}

TEST_F(PhotonQueueFrames, SlowLightsThatStandStillKeepTheirPhotons) {
    // A red lamp that stands still, and a green one that moves so far that only its newest photons
    // count.
    Scene scene = lit_room();
    scene.lights[0].intensity *= glm::vec3(1, 0, 0);
    const Light red = scene.lights[0];
    Light green = red;
    green.intensity = glm::vec3(0, red.intensity.r, 0);
    scene.lights.push_back(green);
    scene.motion.lights.emplace_back();
    for (Material& material : scene.materials) {
        material.base_color = glm::vec3(0.7f);
    }
    World world(device(), scene);
    RenderSettings settings = queue_settings(8);
    settings.photons = 64'000;
    settings.radius = 0.2;
    settings.own["half-life"] = "0.001";
    Session session(world, scene, settings);
    RenderResult moving = frame(session);
    for (int i = 0; i < 10; ++i) {
        scene.lights[1].position.x -= 0.02f;
        moving = frame(session);
    }
    Scene red_only = scene;
    red_only.lights = {red};
    RenderSettings many = settings;
    many.method = "photons";
    many.photons = 2'000'000;
    const RenderResult reference = render(red_only, many);
    const Image& truth = layer(reference, "indirect");
    const auto error = [&](const RenderResult& result) {
        double sum = 0;
        const Image& image = layer(result, "indirect");
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const double d = double(image.pixels[i].r) - double(truth.pixels[i].r);
            sum += d * d;
        }
        return sum;
    };
    Session still(world, scene, settings);
    const double all = error(frame(still));
    RenderSettings fewer = settings;
    fewer.photons /= 8;
    Session one_block(world, scene, fewer);
    const double block = error(frame(one_block));
    EXPECT_GT(block, 3 * all); // else the test could not fail
    EXPECT_LT(error(moving), 2 * all);
}

TEST_F(PhotonQueueFrames, SlowFirstFramesAreAsBrightAsTheOthers) {
    const Scene scene = lit_room();
    World world(device(), scene);
    RenderSettings settings = queue_settings(5, false);
    settings.photons = 20'000;
    settings.radius = 0.4;
    RenderSettings rebuilt = settings;
    rebuilt.method = "photons";
    constexpr int seeds = 12;
    std::array<glm::dvec3, 3> found{};
    glm::dvec3 expected(0);
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        Session session(world, scene, settings);
        for (glm::dvec3& sum : found) {
            sum += mean(layer(frame(session, seed), "indirect"));
        }
        rebuilt.seed = seed;
        expected += mean(layer(render(scene, rebuilt), "indirect"));
    }
    for (const glm::dvec3& sum : found) {
        EXPECT_RELATIVE(sum.x, expected.x, 0.02);
        EXPECT_RELATIVE(sum.z, expected.z, 0.02);
    }
}

TEST_F(PhotonQueueFrames, NoGhostIsLeftWhereALightJumpsOrHasRestedForAWindow) {
    Scene scene = lit_room();
    World world(device(), scene);
    RenderSettings settings = queue_settings(4);
    settings.radius = 0.4;
    Session session(world, scene, settings);
    frame(session);
    // A step: the window's frames later nothing is left of the light from before.
    scene.lights[0].position.x += 0.1f;
    const RenderResult fresh = render(scene, settings);
    RenderResult result = frame(session);
    EXPECT_EQ(result.statistics.photons_emitted, 2'000u);
    EXPECT_FALSE(session.is_current(0));
    for (int i = 0; i < 3; ++i) {
        result = frame(session);
    }
    expect_equal_to_rounding(result, fresh);
    EXPECT_TRUE(session.is_current(0));
    // Switched off, on, and another one that appears: at once, to the bit.
    const Light lamp = scene.lights[0];
    for (const std::vector<Light>& lights :
         {std::vector<Light>{}, {lamp}, {lamp, point_light({0.5f, 0, 0.5f}, glm::vec3(0.5f))}}) {
        scene.lights = lights;
        EXPECT_TRUE(same_bits(frame(session), render(scene, settings))) << lights.size();
    }
}

TEST_F(PhotonQueueFrames, SlowMovingLightIsNotFarBehind) {
    Scene scene = lit_room();
    World world(device(), scene);
    RenderSettings settings = queue_settings(8);
    settings.photons = 80'000;
    Session session(world, scene, settings);
    const float end = scene.lights[0].position.x;
    for (int i = 8; i >= 0; --i) {
        scene.lights[0].position.x = end - 0.03f * static_cast<float>(i);
        frame(session);
    }
    RenderSettings truth = settings_of("path", 12, 4'096);
    scene.lights[0].position.x = end + 0.03f;
    const Image reference = layer(render(scene, truth), "");
    const double moving = compare(layer(frame(session), ""), reference).rel_mse;
    const double still = compare(layer(render(scene, settings), ""), reference).rel_mse;
    EXPECT_LT(moving, 2 * still);
}

TEST_F(PhotonQueueFrames, SlowSurfacesThatMoveLeaveNoPhotonsBehind) {
    Scene scene = moving_scene();
    World world(device(), scene);
    RenderSettings settings = queue_settings(6);
    settings.photons = 60'000;
    settings.radius = 0.2;
    Session session(world, scene, settings);
    for (const double time : {0.0, 0.02, 0.04, 0.06, 0.08, 0.1}) {
        move_to(time, scene);
        world.update(scene);
        const RenderResult found = frame(session);
        EXPECT_EQ(found.statistics.non_finite, 0u);
        const glm::dvec3 expected = mean(layer(render(scene, settings), "indirect"));
        EXPECT_RELATIVE(mean(layer(found, "indirect")).y, expected.y, 0.06) << time;
    }
    for (int i = 0; i < 6; ++i) {
        frame(session);
    }
    expect_equal_to_rounding(frame(session), frame(session));
    EXPECT_RELATIVE(mean(layer(frame(session), "indirect")).y,
                    mean(layer(render(scene, settings), "indirect")).y, 1e-3);
}

TEST_F(PhotonQueueFrames, SlowShadowsOfWhatMovesAreNotLate) {
    // A plate comes before the lamp and goes away again. Photons elsewhere stay, whose paths it
    // does not cross.
    const auto scene_at = [](double time) {
        Scene scene = moving_scene();
        scene.lights.resize(1);
        scene.motion.lights.clear();
        const glm::dvec3 lamp(scene.lights[0].position);
        const glm::dvec3 before = lamp + glm::dvec3(-0.2, -0.4, 0);
        scene.motion.nodes[0].rest.rotation = glm::dquat(1, 1, 0, 0) * std::sqrt(0.5); // level
        scene.motion.nodes[0].keys.translation =
            between(before - glm::dvec3(0.8, 0, 0), before + glm::dvec3(0.8, 0, 0));
        move_to(time, scene);
        return scene;
    };
    RenderSettings settings = queue_settings(6);
    settings.photons = 40'000;
    settings.radius = 0.3;
    constexpr std::uint32_t seeds = 4;
    const std::array<double, 6> times{0, 0.2, 0.4, 0.6, 0.8, 1};
    std::array<double, 6> found{}, expected{};
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        Scene scene = scene_at(0);
        World world(device(), scene);
        Session session(world, scene, settings);
        for (std::size_t i = 0; i < times.size(); ++i) {
            move_to(times[i], scene);
            world.update(scene);
            found[i] += mean(layer(frame(session, seed), "indirect")).y;
            RenderSettings fresh = settings;
            fresh.seed = seed;
            expected[i] += mean(layer(render(scene_at(times[i]), fresh), "indirect")).y;
        }
    }
    const auto [least, most] = std::minmax_element(expected.begin(), expected.end());
    EXPECT_GT(*most, 1.15 * *least); // else the test could not fail
    for (std::size_t i = 0; i < times.size(); ++i) {
        EXPECT_RELATIVE(found[i], expected[i], 0.02) << i;
    }
}

TEST_F(PhotonQueueFrames, FurtherPassesOfAnImageAddABlockEach) {
    const Scene scene = lit_room();
    World world(device(), scene);
    const RenderSettings settings = queue_settings(4);
    Session session(world, scene, settings);
    session.begin_frame(0);
    for (int i = 0; i < 9; ++i) {
        EXPECT_TRUE(session.step({}, proceed_with_frame));
    }
    EXPECT_EQ(session.result().statistics.photons_emitted, 8'000u + 8 * 2'000u);
    // The next frame begins the sequence of photons anew.
    EXPECT_TRUE(session.step({}, proceed_with_frame));
    for (int i = 0; i < 4; ++i) {
        frame(session);
    }
    expect_equal_to_rounding(frame(session), render(scene, settings));
}

TEST_F(PhotonQueueFrames, FramesWithoutPhotonsAreRight) {
    const Scene scene = lit_room();
    World world(device(), scene);
    for (const std::uint64_t photons : {0u, 1u, 3u}) {
        for (const bool fills : {true, false}) {
            RenderSettings settings = queue_settings(8, fills);
            settings.photons = photons;
            settings.radius = 0.4; // else area samples are dense
            Session session(world, scene, settings);
            for (int i = 0; i < 10; ++i) {
                const RenderResult result = frame(session);
                EXPECT_EQ(result.statistics.non_finite, 0u);
                EXPECT_GT(mean(layer(result, "direct")).x, 0);
            }
        }
    }
    RenderSettings settings = queue_settings(8);
    settings.radius = 0.4;
    settings.bounces = 0;
    EXPECT_EQ(mean(layer(render(scene, settings), "indirect")), glm::dvec3(0));
}

TEST_F(PhotonQueueFrames, GoesOnFromASavedStateWithTheSameBits) {
    Scene scene = lit_room();
    World world(device(), scene);
    const RenderSettings settings = queue_settings(4);
    Session session(world, scene, settings);
    frame(session);
    scene.lights[0].position.x += 0.1f;
    session.begin_frame(0);
    EXPECT_TRUE(session.step({}, proceed_with_frame));
    const std::vector<std::uint8_t> state = session.save();
    const auto go_on_from_here = [](Session& from) {
        for (int i = 0; i < 3; ++i) {
            EXPECT_TRUE(from.step({}, proceed_with_frame));
        }
        return from.result();
    };
    const RenderResult expected = go_on_from_here(session);
    Session other(world, scene, settings);
    other.resume(state, 0);
    EXPECT_TRUE(same_bits(go_on_from_here(other), expected));
    const std::vector<std::uint8_t> cut(state.begin(), state.end() - 100);
    EXPECT_THROW(other.resume(cut, 0), Error);
}

TEST_F(PhotonQueueFrames, EstimatesWithoutWhatFramesKeepAreThoseOfOneMoment) {
    Scene scene = lit_room();
    World world(device(), scene);
    const RenderSettings settings = queue_settings(4);
    for (int i = 0; i < 3; ++i) {
        scene.lights[0].position.x += 0.05f;
        Session session(world, scene, settings); // as --keep none
        EXPECT_TRUE(same_bits(frame(session), render(scene, settings)));
    }
}

TEST(LightChange, IsThatOfTheLightThatChangesMost) {
    LightTable before;
    before.lights = {LightRecord{.kind = light_point, .r = 1, .g = 1, .b = 1},
                     LightRecord{.kind = light_directional, .r = 2, .dx = 0, .dy = -1}};
    before.lights[1].dy = -1;
    LightTable now = before;
    EXPECT_EQ(light_change(before, now, 2), 0);
    now.lights[0].x = 0.5f;
    EXPECT_NEAR(light_change(before, now, 2), 0.25, 1e-6);
    now.lights[1].r = 1;
    EXPECT_NEAR(light_change(before, now, 2), 0.5, 1e-6);
    now.lights.pop_back();
    EXPECT_EQ(light_change(before, now, 2), std::numeric_limits<double>::infinity());
}

TEST(LightChange, HowPhotonsFromOutsideAreAimedIsNone) {
    LightTable table;
    table.lights.resize(2);
    table.lights[0].kind = light_directional;
    table.lights[1].kind = light_sky;
    LightTable aimed = table;
    for (LightRecord& light : aimed.lights) {
        light.x = 3;
        light.ex = 4;
        light.triangle_and_sides = 5;
    }
    EXPECT_EQ(light_change(table, aimed, 1), 0);
    aimed.lights[0].dx = 0.25f;
    EXPECT_EQ(light_change(table, aimed, 1), 0.25);
}

TEST(LightChange, HalfLifeBalancesLagAndNoise) {
    // The sum of both errors is greater with a half-life a fifth shorter or longer.
    for (const double change : {0.001, 0.03, 0.3}) {
        for (const double window : {4.0, 64.0}) {
            const double in_disc = 300;
            const double h = balanced_half_life(change, window, in_disc);
            const auto error = [&](double half_life) {
                const double lag = change * half_life / std::log(2.0);
                const double blocks = 2 * half_life / std::log(2.0);
                return lag * lag + window / (blocks * in_disc);
            };
            EXPECT_LT(error(h), error(0.8 * h));
            EXPECT_LT(error(h), error(1.25 * h));
        }
    }
    EXPECT_EQ(balanced_half_life(0, 10, 300), std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace argand::testing
