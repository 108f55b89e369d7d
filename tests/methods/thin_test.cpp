// Things much smaller than the disc of an estimate: their few area samples do not tell the share of
// the disc that lies on surfaces.
#include "rendering.hpp"

namespace argand::testing {
namespace {

/// A corner of a room of 2 m with a plant: leaves of 15 mm across, which fill the view.
Scene plant_scene() {
    Scene scene = room_scene();
    scene.name = "plant";
    add_leaves(scene, {0.2f, 0.2f, 0.3f}, 0.25f, 0.015f, 1500);
    scene.cameras = {look_at({0.2f, 0.2f, 0.95f}, {0.2f, 0.2f, 0.3f}, 30)};
    return scene;
}

/// A cube of 4 cm on the floor of a room of 6 m by 6 m, seen from the other side of the room.
Scene small_cube_scene() {
    Scene scene = scaled(room_scene(), 3);
    scene.name = "small cube";
    add_box(scene, {1.0f, -3, 0.5f}, {1.04f, -2.96f, 0.54f},
            add_material(scene, lambertian(glm::vec3(0.7f))), false);
    scene.cameras = {look_at({0.3f, 0.6f, 2.85f}, {1.02f, -2.98f, 0.52f}, 70)};
    return scene;
}

/// Leaves of 10 cm across, on which a mirror behind the camera throws light.
Scene leaves_beside_mirror() {
    Scene scene = room_scene();
    scene.name = "leaves beside a mirror";
    add_leaves(scene, {0.2f, 0, 0}, 0.4f, 0.1f, 40);
    add_quad(scene, {0.99f, -0.9f, -0.9f}, {0, 0, 1.8f}, {0, 1.8f, 0},
             add_material(scene, mirror()));
    scene.cameras = {look_at({0.95f, 0, 0}, {0, 0, 0}, 80)};
    return scene;
}

class Thin : public EveryMethod {
protected:
    void expect_light_of_path(const Scene& scene, RenderSettings settings, double tolerance) {
        RenderSettings traced = settings;
        traced.method = "path";
        traced.samples = 2048;
        const RenderResult& expected = render_once(scene.name, scene, traced);
        settings.samples = 256;
        settings.photons = 50'000;
        expect_same_layers(render(scene, settings), expected, tolerance);
    }
};

TEST_P(Thin, LeavesHaveTheirIndirectLight) {
    expect_light_of_path(plant_scene(), settings_of(GetParam(), 16, 64), 0.02);
}

TEST_P(Thin, ASmallCubeInALargeRoomHasItsIndirectLight) {
    RenderSettings settings = settings_of(GetParam(), 1024, 64);
    settings.crop = CropRectangle{509, 509, 515, 515};
    expect_light_of_path(small_cube_scene(), settings, 0.03);
}

TEST_P(Thin, LeavesHaveTheLightOfAMirror) {
    const Scene scene = leaves_beside_mirror();
    RenderSettings settings = settings_of("bidirectional", 16, 1024);
    const RenderResult& expected = render_once(scene.name, scene, settings);
    settings = settings_of(GetParam(), 16, 64);
    settings.photons = 20'000;
    const double found = mean(layer(render(scene, settings), "caustic")).g;
    EXPECT_RELATIVE(found, mean(layer(expected, "caustic")).g, 0.1);
}

RenderSettings few_photons(std::uint32_t samples, std::optional<double> least_coverage = {}) {
    RenderSettings settings = settings_of("photons", 8, samples);
    settings.photons = 5'000;
    settings.least_coverage = least_coverage;
    return settings;
}

class LeastCoverage : public RenderTest {};

TEST_F(LeastCoverage, IsLargerWhereSamplesAreMany) {
    const Scene scene = leaves_beside_mirror();
    const RenderResult few = render(scene, few_photons(63)), many = render(scene, few_photons(64));
    EXPECT_EQ(few.statistics.least_coverage, 0.1);
    EXPECT_EQ(many.statistics.least_coverage, 0.2);
    EXPECT_TRUE(same_bits(few, render(scene, few_photons(63, 0.1))));
    EXPECT_TRUE(same_bits(many, render(scene, few_photons(64, 0.2))));
    EXPECT_FALSE(same_bits(many, render(scene, few_photons(64, 0.1))));
    EXPECT_EQ(render(scene, few_photons(64, 0.0)).statistics.least_coverage, 0);
}

TEST_F(LeastCoverage, FollowsFromTheSamplesOfTheSettings) {
    const Scene scene = plant_scene();
    RenderSettings settings = few_photons(64);
    settings.photons_per_pass = 1'000;
    EXPECT_EQ(render(scene, settings).statistics.least_coverage, 0.2);
    settings = few_photons(16);
    settings.progressive.on = true;
    settings.progressive.passes = 4;
    EXPECT_EQ(render(scene, settings).statistics.least_coverage, 0.1);
    settings.method = "photon-queue";
    settings.progressive = {};
    EXPECT_EQ(render(scene, settings).statistics.least_coverage, 0.1);
    settings.samples = 64;
    EXPECT_EQ(render(scene, settings).statistics.least_coverage, 0.2);
}

INSTANTIATE_QUICK_AND_SLOW(Thin, "photons", exact(methods_with_map()));

} // namespace
} // namespace argand::testing
