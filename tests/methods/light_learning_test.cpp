// Lights are chosen by the light that arrives where it is needed, in scenes with many lights or
// with a strong one that does not reach what is in view.
#include "rendering.hpp"

#include "scene/studio.hpp"

namespace argand::testing {
namespace {

class LightLearning : public EveryMethod {};

/// A closed room of 4 m with a lamp, seen from inside.
Scene closed_room() {
    Scene scene;
    const std::uint32_t white = add_material(scene, lambertian({0.7f, 0.6f, 0.5f}));
    const std::uint32_t lamp = add_material(scene, emitter(glm::vec3(10)));
    add_box(scene, {-2, 0, -2}, {2, 2.5f, 2}, white, true);
    add_box(scene, {-0.5f, -0.01f, -0.8f}, {0.6f, 0.7f, 0.2f}, white, false);
    add_quad(scene, {-0.3f, 2.4f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}, lamp);
    scene.cameras = {look_at({1.7f, 1.5f, 1.7f}, {-0.6f, 0.7f, -0.7f}, 70)};
    return scene;
}

/// The same room in a shell, on a ground of 200 m in the sun, which does not come in.
Scene sunlit_room() {
    Scene scene = closed_room();
    const std::uint32_t outside = add_material(scene, lambertian(glm::vec3(0.4f)));
    add_floor(scene, 100, -0.5f, outside);
    add_box(scene, {-2.4f, -0.4f, -2.4f}, {2.4f, 2.9f, 2.4f}, outside, false);
    scene.lights = {
        directional_light(glm::normalize(glm::vec3(-0.5f, -1, -0.4f)), glm::vec3(1e5f))};
    return scene;
}

RenderSettings small_picture(const std::string& method) {
    RenderSettings settings = settings_of(method, 32, 16);
    settings.photons = 20'000;
    return settings;
}

RenderSettings reference(std::uint32_t samples) {
    RenderSettings settings = settings_of("path", 32, samples);
    settings.seed = 1;
    return settings;
}

// The sun has 10^8 times the power of the lamp, and must not take its samples.
TEST_P(LightLearning, SunThatDoesNotComeIn) {
    const RenderResult with_sun = render(sunlit_room(), small_picture(GetParam()));
    const RenderResult twin = render(closed_room(), small_picture(GetParam()));
    const RenderResult& truth = render_once("closed room", closed_room(), reference(512));
    for (const char* name : {"direct", "indirect"}) {
        SCOPED_TRACE(name);
        const Image& expected = layer(truth, name);
        const double of_twin = compare(layer(twin, name), expected).rel_mse;
        EXPECT_LT(compare(layer(with_sun, name), expected).rel_mse, 2 * of_twin);
        EXPECT_RELATIVE(mean(layer(with_sun, name)).g, mean(expected).g, 0.05);
    }
}

// A lamp in a closed sphere lights nothing: its photons all lie there, far from what is in view.
TEST_P(LightLearning, LampInAClosedSphere) {
    Scene scene;
    const std::uint32_t white = add_material(scene, lambertian(glm::vec3(0.7f)));
    add_box(scene, {-8, 0, -8}, {8, 6, 8}, white, true);
    add_box(scene, {-2, 0, -3}, {-1, 2, -2}, white, false);
    Light lamp;
    lamp.position = {0.3f, 4, 0.2f};
    lamp.intensity = glm::vec3(100);
    scene.lights = {lamp};
    scene.cameras = {look_at({6, 3, 6}, {-2, 1, -2}, 60)};
    RenderSettings settings = settings_of(GetParam(), 16, 4);
    settings.photons = 20'000;
    const double open = mean(layer(render(scene, settings), "")).g;
    EXPECT_GT(open, 0.1);
    // Some facet of the sphere lies in the plane of every surface that it faces.
    add_sphere(scene, lamp.position, 0.1f, 24, false, white);
    EXPECT_LT(mean(layer(render(scene, settings), "")).g, 1e-6 * open);
}

// One room of a row is in view. The others' lamps must not take its samples and photons.
TEST_P(LightLearning, LampsOfOtherRooms) {
    Scene row = closed_room();
    for (int i = 1; i < 20; ++i) {
        const float x = 5.0f * static_cast<float>(i);
        add_box(row, {x - 2, 0, -2}, {x + 2, 2.5f, 2}, 0, true);
        add_quad(row, {x - 0.3f, 2.4f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}, 1);
    }
    const RenderResult one_of_many = render(row, small_picture(GetParam()));
    const RenderResult& truth = render_once("closed room", closed_room(), reference(512));
    EXPECT_LT(compare(layer(one_of_many, "direct"), layer(truth, "direct")).rel_mse, 0.02);
    EXPECT_LT(compare(layer(one_of_many, "indirect"), layer(truth, "indirect")).rel_mse, 0.2);
    EXPECT_RELATIVE(mean(layer(one_of_many, "indirect")).g, mean(layer(truth, "indirect")).g, 0.06);
}

// A room that the sun lights through a window, on a ground of 200 m. Nearly all photons would fall
// on the ground.
TEST_P(LightLearning, SunThroughAWindow) {
    Scene scene;
    const std::uint32_t white = add_material(scene, lambertian({0.7f, 0.6f, 0.5f}));
    add_floor(scene, 20, -0.5f, white);
    add_box(scene, {-2, 0, -2}, {2, 2.5f, 2}, white, true);
    scene.triangles.resize(scene.triangles.size() - 2); // the wall at z = 2
    scene.triangle_material.resize(scene.triangles.size());
    add_quad(scene, {2, 0, 2}, {-4, 0, 0}, {0, 1, 0}, white); // up to the window
    add_quad(scene, {2, 1.8f, 2}, {-4, 0, 0}, {0, 0.7f, 0}, white);
    scene.lights = {directional_light(glm::normalize(glm::vec3(0, -0.8f, -1)), glm::vec3(100))};
    scene.cameras = {look_at({1.7f, 1.5f, 1.7f}, {-0.6f, 0.7f, -0.7f}, 70)};
    const RenderResult found = render(scene, small_picture(GetParam()));
    EXPECT_TRUE(found.statistics.photons_emitted == 0 || found.statistics.photons_stored > 5000)
        << found.statistics.photons_stored;
    const RenderResult& truth = render_once("room with a window", scene, reference(1024));
    EXPECT_RELATIVE(mean(layer(found, "indirect")).g, mean(layer(truth, "indirect")).g, 0.15);
}

/// A room of 2 m with an opening in one wall, under the sky and, if it shines, a sun.
Scene room_with_opening(bool sun) {
    Scene scene;
    const std::uint32_t white = add_material(scene, lambertian({0.7f, 0.6f, 0.5f}));
    add_box(scene, {-1, 0, -1}, {1, 2, 1}, white, true);
    scene.triangles.resize(scene.triangles.size() - 2); // the wall at z = 1
    scene.triangle_material.resize(scene.triangles.size());
    add_quad(scene, {1, 0, 1}, {-2, 0, 0}, {0, 0.8f, 0}, white); // up to the opening
    add_quad(scene, {1, 1.6f, 1}, {-2, 0, 0}, {0, 0.4f, 0}, white);
    scene.sky = glm::vec3(1);
    if (sun) {
        scene.lights = {
            directional_light(glm::normalize(glm::vec3(0.2f, -0.8f, -1)), glm::vec3(3))};
    }
    scene.cameras = {look_at({0.8f, 1, 0.8f}, {-0.3f, 0.7f, -0.8f}, 70)};
    return scene;
}

// What the room gets by photons that are aimed through its opening is, in the mean over seeds, what
// it gets by path tracing.
TEST_P(LightLearning, SlowSkyAndSunThroughAnOpening) {
    for (const bool sun : {false, true}) {
        SCOPED_TRACE(sun);
        const Scene scene = room_with_opening(sun);
        const RenderResult& truth =
            render_once(sun ? "opening, sun" : "opening", scene, reference(1024));
        double sum = 0;
        constexpr int seeds = 4;
        for (int seed = 0; seed < seeds; ++seed) {
            RenderSettings settings = small_picture(GetParam());
            settings.seed = static_cast<std::uint32_t>(seed) + 10;
            const RenderResult found = render(scene, settings);
            sum += mean(layer(found, "indirect")).g / seeds;
            if (found.statistics.photons_emitted > 0) {
                // 1.6 m² of opening let in 0.042 of the photons that start on a disc of 9.4 m².
                EXPECT_GT(found.statistics.photons_in_view,
                          0.12 * static_cast<double>(found.statistics.photons_emitted));
            }
        }
        EXPECT_RELATIVE(sum, mean(layer(truth, "indirect")).g, 0.03);
    }
}

// The same for a picture, brighter above, whose sun shines through the opening: photons learn which
// part of the sky they should come from, too.
TEST_P(LightLearning, SlowPictureWithASunThroughAnOpening) {
    Scene scene = room_with_opening(false);
    scene.sky.reset();
    Environment sky = studio();
    sky.rotation = 30;
    sky.sun = Sun{.towards = glm::normalize(glm::vec3(-0.7f, 0.8f, 0.75f)),
                  .radius = 0.05f,
                  .radiance = glm::vec3(400)};
    scene.environment = sky;
    const RenderResult& truth = render_once("opening, picture", scene, reference(2048));
    double sum = 0;
    constexpr int seeds = 4;
    for (int seed = 0; seed < seeds; ++seed) {
        RenderSettings settings = small_picture(GetParam());
        settings.seed = static_cast<std::uint32_t>(seed) + 10;
        const RenderResult found = render(scene, settings);
        sum += mean(layer(found, "indirect")).g / seeds;
        if (found.statistics.photons_emitted > 0) {
            EXPECT_GT(found.statistics.photons_in_view,
                      0.12 * static_cast<double>(found.statistics.photons_emitted));
        }
    }
    EXPECT_RELATIVE(sum, mean(layer(truth, "indirect")).g, 0.03);
}

// With one photon, or with a light that reaches nothing in view, little is learnt.
TEST_P(LightLearning, NothingToAimAt) {
    Scene scene = room_with_opening(true);
    RenderSettings settings = small_picture(GetParam());
    settings.photons = 1;
    EXPECT_TRUE(std::isfinite(mean(layer(render(scene, settings), "")).g));
    // The sun shines on the room's back only.
    scene.lights[0].direction = glm::vec3(0, 0, 1);
    EXPECT_GT(mean(layer(render(scene, small_picture(GetParam())), "")).g, 0);
    // The camera looks away from everything.
    scene.cameras = {look_at({0, 1, 20}, {0, 1, 40}, 40)};
    EXPECT_RELATIVE(mean(layer(render(scene, small_picture(GetParam())), "")).g, 1, 1e-5);
}

// Lights that shadow rays do not find, because glass is in the way.
class HiddenLights : public RenderTest {
protected:
    RenderResult picture(const char* asset, const char* method) {
        RenderSettings settings = small_picture(method);
        settings.photons = 50'000;
        return render(load_asset(asset), settings);
    }

    double photons_in_view(const char* asset, const char* method) {
        return picture(asset, method).statistics.photons_in_view;
    }
};

TEST_F(HiddenLights, LampsInBulbsOfOtherRooms) {
    const RenderResult forty = picture("forty_bulbs.glb", "photons");
    const RenderResult one = picture("bulb.glb", "photons");
    EXPECT_GT(forty.statistics.photons_in_view, 0.8 * one.statistics.photons_in_view);
    EXPECT_RELATIVE(mean(layer(forty, "")).g, mean(layer(one, "")).g, 0.02);
    // Both have noise of their own.
    EXPECT_LT(compare(layer(forty, "indirect"), layer(one, "indirect")).rel_mse, 0.05);
}

TEST_F(HiddenLights, SlowLampsInBulbsOfOtherRoomsFillAQueue) {
    EXPECT_GT(photons_in_view("forty_bulbs.glb", "photon-queue"),
              0.8 * photons_in_view("bulb.glb", "photon-queue"));
}

TEST_F(HiddenLights, SunThroughAPane) {
    EXPECT_GT(photons_in_view("glazed_room.glb", "photons"),
              0.7 * photons_in_view("window_room.glb", "photons"));
}

INSTANTIATE_QUICK_AND_SLOW(LightLearning, "footprints", estimates);

} // namespace
} // namespace argand::testing
