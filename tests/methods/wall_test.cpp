// A wall that stands on a floor, with a brighter room behind it: the floor goes on behind the wall,
// within the discs of estimates before it.
#include "rendering.hpp"

namespace argand::testing {
namespace {

/// Two rooms of 2 m with a wall of this thickness between them, seen from the first. The lamp of
/// the second is so many times as strong.
Scene two_rooms(float thickness, float ratio) {
    Scene scene;
    scene.name = "two rooms " + std::to_string(thickness) + " " + std::to_string(ratio);
    Material material = lambertian(glm::vec3(0.6f));
    material.double_sided = true;
    const std::uint32_t white = add_material(scene, material);
    add_box(scene, {-1, -1, -1}, {3 + thickness, 1, 1}, white, true);
    if (thickness > 0) {
        add_box(scene, {1, -1.01f, -1.01f}, {1 + thickness, 1.01f, 1.01f}, white, false);
    } else {
        add_quad(scene, {1, -1, 1}, {0, 0, -2}, {0, 2, 0}, white);
    }
    scene.lights = {point_light({-0.2f, 0.7f, 0}, glm::vec3(1)),
                    point_light({2.2f, 0.7f, 0.1f}, glm::vec3(ratio))};
    scene.cameras = {look_at({-0.8f, 0.2f, 0.7f}, {1, -0.7f, -0.3f}, 60)};
    return scene;
}

class Walls : public EveryMethod {
protected:
    void expect_light_of_path(const Scene& scene) {
        RenderSettings traced = settings_of("path", 24, 512);
        const RenderResult& expected = render_once(scene.name, scene, traced);
        RenderSettings settings = settings_of(GetParam(), 24, 64);
        settings.photons = 50'000;
        const RenderResult found = render(scene, settings);
        // Without the rays, relMSE is about 1,000 if the lamp behind the wall is 1,000 times as
        // strong (docs/results/rooms.md).
        expect_same_layers(found, expected, 0.05);
        EXPECT_LT(compare(layer(found, "indirect"), layer(expected, "indirect")).rel_mse, 0.1)
            << scene.name;
    }
};

TEST_P(Walls, LightOfABrightRoomDoesNotLeakBeforeThem) {
    expect_light_of_path(two_rooms(0.05f, 1000));
}

TEST_P(Walls, SlowOfAnyThicknessBetweenRooms) {
    expect_light_of_path(two_rooms(0, 1000));
    expect_light_of_path(two_rooms(0.05f, 20));
    expect_light_of_path(two_rooms(0.3f, 1e6f));
}

INSTANTIATE_QUICK_AND_SLOW(Walls, "photons", exact(methods_with_map()));

} // namespace
} // namespace argand::testing
