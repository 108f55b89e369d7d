// Lamps close to surfaces: the bright spot there is rarely hit by paths that look for reflected
// light, which are aimed at it instead.
#include "rendering.hpp"

#include <random>

namespace argand::testing {
namespace {

Light lamp_at(glm::vec3 position, float intensity) {
    Light lamp;
    lamp.position = position;
    lamp.intensity = glm::vec3(intensity);
    return lamp;
}

/// A room of 4 m by 4 m, 2.5 m high, seen from a corner.
Scene room(const std::string& name) {
    Scene scene;
    scene.name = name;
    const std::uint32_t white = add_material(scene, lambertian({0.7f, 0.6f, 0.5f}));
    add_box(scene, {-2, 0, -2}, {2, 2.5f, 2}, white, true);
    add_box(scene, {-0.5f, -0.01f, -0.8f}, {0.6f, 0.7f, 0.2f}, white, false);
    scene.cameras = {look_at({1.7f, 1.5f, 1.7f}, {-0.6f, 0.3f, -0.7f}, 60)};
    return scene;
}

/// A lamp 4 mm below the ceiling.
Scene ceiling_lamp() {
    Scene scene = room("ceiling lamp");
    scene.lights = {lamp_at({0.1f, 2.496f, 0.2f}, 5)};
    return scene;
}

/// A lamp in a shade of 16 cm that is open at both ends.
Scene shaded_lamp() {
    Scene scene = room("shaded lamp");
    scene.lights = {lamp_at({0.1f, 1.6f, 0.2f}, 5)};
    Material shade = lambertian({0.8f, 0.7f, 0.6f});
    shade.double_sided = true;
    const std::uint32_t material = add_material(scene, shade);
    for (int i = 0; i < 16; ++i) {
        const auto around = [&](int k) {
            const float turn = 2 * pi * float(k) / 16;
            return glm::vec3(0.1f + 0.08f * std::cos(turn), 1.5f, 0.2f + 0.08f * std::sin(turn));
        };
        add_quad(scene, around(i), around(i + 1) - around(i), {0, 0.2f, 0}, material);
    }
    return scene;
}

/// Leaves in view, at which photon methods take no estimate, below a lamp 4 mm from the ceiling.
Scene leaves_under_lamp() {
    Scene scene = ceiling_lamp();
    scene.name = "leaves under lamp";
    Material leaf = lambertian({0.5f, 0.7f, 0.4f});
    leaf.double_sided = true;
    const std::uint32_t material = add_material(scene, leaf);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> within(-1, 1);
    const auto anywhere = [&] { return glm::vec3(within(random), within(random), within(random)); };
    const auto direction = [&] { return glm::normalize(anywhere() + glm::vec3(0, 0, 1e-3f)); };
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 across = direction();
        const glm::vec3 up = glm::normalize(glm::cross(across, direction()));
        add_quad(scene, glm::vec3(0.5f, 0.9f, 0.5f) + 0.35f * anywhere(), 0.02f * across,
                 0.02f * up, material);
    }
    scene.cameras = {look_at({1.5f, 1.3f, 1.5f}, {0.5f, 0.9f, 0.5f}, 40)};
    return scene;
}

class CloseLights : public EveryMethod {
protected:
    /// Renders the scene with few samples, and returns the error of its indirect layer, whose mean
    /// must be that of `bidirectional`, which traces that light from the lamps.
    double indirect_error(const Scene& scene, std::uint32_t samples) {
        RenderSettings traced = settings_of("bidirectional", 32, 128);
        traced.seed = 9;
        const RenderResult& truth = render_once(scene.name, scene, traced);
        RenderSettings settings = settings_of(GetParam(), 32, samples);
        settings.photons = 20'000;
        const RenderResult found = render(scene, settings);
        const Image& indirect = layer(found, "indirect");
        const Image& expected = layer(truth, "indirect");
        EXPECT_RELATIVE(mean(indirect).g, mean(expected).g, 0.05);
        return compare(indirect, expected).rel_mse;
    }
};

TEST_P(CloseLights, ALampBelowTheCeiling) { EXPECT_LT(indirect_error(ceiling_lamp(), 64), 0.3); }

TEST_P(CloseLights, ALampInAShade) { EXPECT_LT(indirect_error(shaded_lamp(), 64), 1.3); }

TEST_P(CloseLights, LeavesUnderALamp) { EXPECT_LT(indirect_error(leaves_under_lamp(), 64), 0.3); }

INSTANTIATE_ESTIMATES(CloseLights);

} // namespace
} // namespace argand::testing
