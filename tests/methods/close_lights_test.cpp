// Lamps close to surfaces: the bright spot there is rarely hit by paths that look for reflected
// light, which are aimed at it instead.
#include "rendering.hpp"

namespace argand::testing {
namespace {

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
    scene.lights = {point_light({0.1f, 2.496f, 0.2f}, glm::vec3(5))};
    return scene;
}

/// A lamp in a shade of 16 cm that is open at both ends.
Scene shaded_lamp() {
    Scene scene = room("shaded lamp");
    scene.lights = {point_light({0.1f, 1.6f, 0.2f}, glm::vec3(5))};
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
    add_leaves(scene, {0.5f, 0.9f, 0.5f}, 0.35f, 0.02f, 1000);
    scene.cameras = {look_at({1.5f, 1.3f, 1.5f}, {0.5f, 0.9f, 0.5f}, 40)};
    return scene;
}

Scene glossy(Scene scene, float roughness) {
    for (Material& material : scene.materials) {
        material.specular = 1;
        material.roughness = roughness;
    }
    return scene;
}

class CloseLights : public EveryMethod {
protected:
    /// Renders the scene with few samples, and compares the means of its layers with those of
    /// `bidirectional`, which finds the light of lamps by paths from there.
    RenderResult render_with_right_means(const Scene& scene, std::uint32_t samples = 64,
                                         bool final_gather = false) {
        RenderSettings settings = settings_of(GetParam(), 32, samples);
        settings.photons = 20'000;
        settings.final_gather = final_gather;
        RenderResult found = render(scene, settings);
        const auto mean_of = [](const RenderResult& result, const std::string& name) {
            return mean(layer(result, name)).g;
        };
        EXPECT_RELATIVE(mean_of(found, "direct"), mean_of(truth(scene), "direct"), 0.02);
        EXPECT_RELATIVE(mean_of(found, "indirect"), mean_of(truth(scene), "indirect"), 0.06);
        return found;
    }

    const RenderResult& truth(const Scene& scene) {
        RenderSettings traced = settings_of("bidirectional", 32, 256);
        traced.seed = 9;
        return render_once(scene.name, scene, traced);
    }

    double indirect_error(const RenderResult& found, const Scene& scene) {
        return compare(layer(found, "indirect"), layer(truth(scene), "indirect")).rel_mse;
    }
};

// Without aimed paths the mean of 64 samples is off by more than the light itself.
TEST_P(CloseLights, LeavesUnderALamp) {
    const Scene scene = leaves_under_lamp();
    EXPECT_LT(indirect_error(render_with_right_means(scene), scene), 1);
}

// Aimed paths find other lights, too.
TEST_P(CloseLights, BesideOtherLights) {
    Scene scene = leaves_under_lamp();
    scene.name = "leaves under a lamp, and a panel";
    add_quad(scene, {-1.99f, 0.5f, 1}, {0, 0, -2}, {0, 1, 0},
             add_material(scene, emitter(glm::vec3(2))));
    render_with_right_means(scene);
}

TEST_P(CloseLights, SlowWithoutWallsUnderASky) {
    Scene scene = leaves_under_lamp();
    scene.name = "leaves under a plate in the open";
    scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + 12);
    scene.triangle_material.erase(scene.triangle_material.begin(),
                                  scene.triangle_material.begin() + 12);
    add_box(scene, {-0.3f, 2.5f, -0.2f}, {0.5f, 2.6f, 0.6f},
            add_material(scene, lambertian(glm::vec3(0.7f))), false);
    scene.sky = glm::vec3(0.3f);
    render_with_right_means(scene, 512);
}

TEST_P(CloseLights, GlossyLeaves) {
    Scene scene = glossy(leaves_under_lamp(), 0.3f);
    scene.name = "glossy leaves under a lamp";
    render_with_right_means(scene);
}

// The densities of narrow lobes are tiny in most directions. Each render() expects finite samples.
TEST_P(CloseLights, NarrowLobes) {
    RenderSettings settings = settings_of(GetParam(), 32, 16);
    settings.photons = 20'000;
    render(glossy(leaves_under_lamp(), 0.05f), settings);
    Scene phong = leaves_under_lamp();
    for (Material& material : phong.materials) {
        material.phong = Phong{.specular = glm::vec3(0.5f), .exponent = 1000};
    }
    render(phong, settings);
}

INSTANTIATE_ESTIMATES(CloseLights);

class GathersFromCloseLights : public CloseLights {};

TEST_P(GathersFromCloseLights, SlowWithFinalGather) {
    render_with_right_means(ceiling_lamp(), 64, true);
}

INSTANTIATE_TEST_SUITE_P(Methods, GathersFromCloseLights,
                         ::testing::ValuesIn(without(estimates, "path")));

class PathsToCloseLights : public CloseLights {};

TEST_P(PathsToCloseLights, ALampBelowTheCeiling) {
    const Scene scene = ceiling_lamp();
    EXPECT_LT(indirect_error(render_with_right_means(scene), scene), 1);
}

TEST_P(PathsToCloseLights, ALampInAShade) {
    const Scene scene = shaded_lamp();
    EXPECT_LT(indirect_error(render_with_right_means(scene), scene), 1);
}

TEST_P(PathsToCloseLights, ASpotLightCloseToAWall) {
    Scene scene = room("spot light");
    scene.lights = {spot_light({1.99f, 1.2f, -0.5f}, {1, 0, 0.1f}, glm::vec3(5), 0.5f, 1.0f)};
    EXPECT_LT(indirect_error(render_with_right_means(scene, 256), scene), 1);
}

// More lamps than eye paths are aimed at.
TEST_P(PathsToCloseLights, SlowFortyLamps) {
    Scene scene = room("forty lamps");
    for (int i = 0; i < 40; ++i) {
        const glm::vec3 place(-1.8f + 0.4f * float(i % 10), 2.45f, -1.5f + float(i / 10));
        scene.lights.push_back(point_light(place, glm::vec3(0.1f)));
    }
    render_with_right_means(scene);
}

INSTANTIATE_TEST_SUITE_P(Methods, PathsToCloseLights, ::testing::Values("path"));

} // namespace
} // namespace argand::testing
