// Modified Phong surfaces, rendered by every method.
#include "rendering.hpp"

namespace argand::testing {
namespace {

Material phong(glm::vec3 diffuse, glm::vec3 specular, float exponent) {
    Material material = lambertian(diffuse);
    material.phong = Phong{specular, exponent};
    return material;
}

class PhongSurface : public EveryMethod {};

TEST_P(PhongSurface, ReflectsASunAsTheFormulaSays) {
    for (const float exponent : {0.0f, 1.0f, 30.0f, 3000.0f}) {
        for (const float off : {0.0f, 1.0f, 20.0f}) { // degrees from the mirror direction
            Scene scene = floor_scene(phong({0.25f, 0.5f, 0}, {0.5f, 0.25f, 0.75f}, exponent));
            scene.lights = {directional_light({-1, -1, 0}, glm::vec3(2))};
            const float angle = glm::radians(45 + off);
            RenderSettings settings = settings_of(GetParam(), 4, 4);
            settings.photons = 1000;
            const glm::dvec3 l =
                radiance(scene, settings, {-3 * std::sin(angle), 3 * std::cos(angle), 0}, {0, 0, 0},
                         "direct");
            const double lobe = (double(exponent) + 2) / (2 * double(pi)) *
                                std::pow(std::cos(glm::radians(double(off))), double(exponent));
            const double e = 2 * std::sqrt(0.5);
            // The lobe varies a little across the image's 1e-4.
            EXPECT_NEAR(l.r, e * (0.25 / pi + 0.5 * lobe), 2e-3 * (1 + lobe))
                << exponent << ", " << off;
            EXPECT_NEAR(l.g, e * (0.5 / pi + 0.25 * lobe), 2e-3 * (1 + lobe))
                << exponent << ", " << off;
            EXPECT_NEAR(l.b, e * 0.75 * lobe, 2e-3 * (1 + lobe)) << exponent << ", " << off;
        }
    }
}

// An estimated lobe and a followed one.
TEST_P(PhongSurface, SlowLayersAgreeWithThePathTracer) {
    Scene scene = box_scene(lambertian({0.6f, 0.5f, 0.4f}));
    add_quad(scene, {-0.5f, 0.95f, -0.5f}, {1, 0, 0}, {0, 0, 1},
             add_material(scene, emitter(glm::vec3(2))));
    add_floor(scene, 0.9f, -0.8f,
              add_material(scene, phong({0.2f, 0.4f, 0.3f}, {0.7f, 0.5f, 0.3f}, 12)));
    add_quad(scene, {-0.9f, -0.7f, -0.6f}, {0, 1, 0}, {1, 0, -0.3f},
             add_material(scene, phong(glm::vec3(0.1f), glm::vec3(0.8f), 2000)));
    scene.cameras = {look_at({0.3f, -0.1f, 0.95f}, {0, -0.4f, -1}, 70)};
    // The path tracer is noisy where a path must hit the lamp.
    RenderSettings reference = settings_of("path", 16, 4096);
    reference.seed = 7;
    const RenderResult& expected = render_once("Phong surfaces", scene, reference);
    RenderSettings settings = settings_of(GetParam(), 16, has_map(GetParam()) ? 128 : 4096);
    settings.photons = 200'000;
    const RenderResult found = render(scene, settings);
    expect_same_layers(found, expected, 0.05);
    EXPECT_GT(mean(layer(expected, "caustic")).g, 0.01 * mean(layer(expected, "direct")).g);
}

INSTANTIATE_ESTIMATES(PhongSurface);

} // namespace
} // namespace argand::testing
