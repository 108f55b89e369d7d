// Surfaces with partial coverage (alpha): eye paths and photons continue through the rest of them.
#include "rendering.hpp"

namespace argand::testing {
namespace {

Material with_alpha(Material material, float alpha) {
    material.coverage = alpha;
    return material;
}

class Alpha : public EveryMethod {
protected:
    RenderSettings settings(int size, std::uint32_t samples, std::uint64_t photons) const {
        RenderSettings s = settings_of(GetParam(), size, samples);
        s.photons = photons;
        return s;
    }
};

TEST_P(Alpha, MixesTheSurfaceWithWhatIsBehind) {
    for (const float degrees : {0.0f, 60.0f, 89.0f}) {
        Scene scene;
        const auto veil = add_material(scene, with_alpha(lambertian({0.5f, 0.2f, 0}), 0.25f));
        add_quad(scene, {-500, -50, 0}, {1000, 0, 0}, {0, 100, 0}, veil);
        add_quad(scene, {-500, -50, -1}, {1000, 0, 0}, {0, 100, 0}, veil);
        add_quad(scene, {-5000, -5000, -2}, {10000, 0, 0}, {0, 10000, 0},
                 add_material(scene, emitter({0, 1, 2})));
        scene.lights = {directional_light({0, 0, -1}, glm::vec3(4 * pi))};
        const glm::vec3 from(3 * std::tan(glm::radians(degrees)), 0, 3);
        const glm::dvec3 l = radiance(scene, settings(8, 512, 1000), from, {0, 0, 0}, "direct");
        // The emitter also lights the far sides of the veils, which the camera does not see.
        EXPECT_NEAR(l.r, 0.25 * 0.5 * 4, 0.01) << degrees;
        EXPECT_NEAR(l.g, 0.25 * 0.2 * 4 + 0.75 * 0.75 * 1, 0.02) << degrees;
        EXPECT_NEAR(l.b, 0.75 * 0.75 * 2, 0.04) << degrees;
    }
}

TEST_P(Alpha, SunBehindItIsACaustic) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 3);
    for (const float height : {1.0f, 1.5f}) {
        add_floor(scene, 4, height, add_material(scene, with_alpha(lambertian({1, 0, 0}), 0.25f)));
    }
    scene.lights = {directional_light({0, -1, 0}, glm::vec3(1))};
    scene.cameras = {parallel_rays({0, 0.6f, 4}, {0, 0, 0}, 0.1f)};
    const RenderResult result = render(scene, settings(8, 16, 200'000));
    // Veils block the path tracer's shadow rays, and its paths cannot hit the sun. Photons pass.
    const double expected = is_unbiased(GetParam()) ? 0 : 0.75 * 0.75 * 0.5 / pi;
    EXPECT_NEAR(mean(layer(result, "caustic")).g, expected, 0.03 * 0.5 / pi);
    EXPECT_EQ(mean(layer(result, "direct")).g, 0);
}

// An area light, which both paths and photons find behind a veil. Each layer is compared by itself.
TEST_P(Alpha, SlowLayersAgreeWithThePathTracer) {
    Scene scene = box_scene(lambertian({0.6f, 0.5f, 0.4f}));
    add_quad(scene, {-0.5f, 0.95f, -0.5f}, {1, 0, 0}, {0, 0, 1},
             add_material(scene, emitter(glm::vec3(2))));
    Material varnished = lambertian({0.2f, 0.6f, 0.7f});
    varnished.specular = 1;
    varnished.roughness = 0.6f;
    add_floor(scene, 0.7f, 0.2f, add_material(scene, with_alpha(varnished, 0.4f)));
    add_quad(scene, {-0.6f, -0.9f, -0.2f}, {0.8f, 0, 0}, {0, 0.8f, -0.2f},
             add_material(scene, with_alpha(mirror({0.9f, 0.8f, 0.7f}), 0.5f)));
    scene.cameras = {look_at({0.3f, -0.1f, 0.95f}, {0, -0.4f, -1}, 70)};
    // The path tracer is noisy where a path must hit the lamp.
    RenderSettings reference = settings_of("path", 16, 4096);
    reference.seed = 7;
    const RenderResult& expected = render_once("veils", scene, reference);
    const RenderResult found =
        render(scene, settings(16, has_map(GetParam()) ? 128 : 4096, 200'000));
    expect_same_layers(found, expected, 0.04);
    EXPECT_GT(mean(layer(expected, "caustic")).g, 0.1 * mean(layer(expected, "direct")).g);
}

INSTANTIATE_METHODS(Alpha);

} // namespace
} // namespace argand::testing
