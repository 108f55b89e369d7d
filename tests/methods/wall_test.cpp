// Walls and bodies that stand on a floor: the floor goes on behind the wall, where another room may
// be bright, and inside the body, where it is dark, within the discs of estimates before them.
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
        // With --least-coverage 0, relMSE is about 1,000 if the lamp behind the wall is 1,000 times
        // as strong (docs/results/rooms.md).
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

/// A block in a room, seen from above.
Scene block_in_room() {
    Scene scene;
    scene.name = "block in a room";
    const std::uint32_t white = add_material(scene, lambertian(glm::vec3(0.7f)));
    add_box(scene, {-1, -1, -1}, {1, 1, 1}, white, true);
    add_box(scene, {-0.6f, -1.01f, -0.5f}, {0, -0.5f, 0.5f}, white, false);
    scene.lights = {point_light({0.3f, 0.8f, 0.1f}, glm::vec3(1))};
    scene.cameras = {look_at({0.001f, 0.95f, 0}, {0, -1, 0}, 50)};
    return scene;
}

/// Two rooms without a roof, with a thin wall between them, seen from above. The lamp of one is
/// 1,000 times as strong.
Scene rooms_from_above() {
    Scene scene;
    scene.name = "rooms from above";
    const std::uint32_t white = add_material(scene, lambertian(glm::vec3(0.6f)));
    add_box(scene, {-2, -0.1f, -1}, {2, 0, 1}, white, false);
    add_box(scene, {-0.01f, -0.01f, -1}, {0.01f, 1, 1}, white, false);
    for (const float z : {-1.1f, 1.0f}) {
        add_box(scene, {-2, -0.05f, z}, {2, 1, z + 0.1f}, white, false);
    }
    scene.lights = {point_light({-1, 0.7f, 0.2f}, glm::vec3(1)),
                    point_light({1, 0.5f, -0.1f}, glm::vec3(1000))};
    scene.cameras = {look_at({0, 5, 0.001f}, {0, 0, 0}, 26)};
    return scene;
}

// The floor inside the block is dark, and no part of the floor around it: estimates at the block's
// foot are not to be 0.6 of what they should be.
TEST_P(Walls, ABodyHasNoDarkRingAroundItsFoot) {
    const Scene scene = block_in_room();
    const RenderResult& expected = render_once(scene.name, scene, settings_of("path", 32, 2048));
    RenderSettings settings = settings_of(GetParam(), 32, 64);
    settings.photons = 1'000'000;
    const RenderResult found = render(scene, settings);
    // The camera's right is -x: the floor beside the foot is left of the middle.
    const auto foot = [](const RenderResult& result) {
        return mean(layer(result, "indirect"), 14, 10, 16, 22).g;
    };
    EXPECT_RELATIVE(foot(found), foot(expected), 0.08);
}

// Queries on both sides of the wall share cells, and both floors are in view.
TEST_P(Walls, SlowNoLightLeaksWhereBothSidesAreInView) {
    const Scene scene = rooms_from_above();
    const RenderResult& expected = render_once(scene.name, scene, settings_of("path", 24, 1024));
    RenderSettings settings = settings_of(GetParam(), 24, 64);
    settings.photons = 200'000;
    const RenderResult found = render(scene, settings);
    // With --least-coverage 0 it is above 1,000.
    EXPECT_LT(compare(layer(found, "indirect"), layer(expected, "indirect")).rel_mse, 0.02);
}

INSTANTIATE_QUICK_AND_SLOW(Walls, "photons", exact(methods_with_map()));

} // namespace
} // namespace argand::testing
