// Coats, sheen, thin films and dispersion, rendered by every method.
#include "rendering.hpp"

namespace argand::testing {
namespace {

class Coats : public EveryMethod {};

// Paint under varnish, lit by a sun: what passes the coat, and a rough coat's own reflection.
TEST_P(Coats, ReflectASunAsTheFormulaSays) {
    for (const float roughness : {0.0f, 0.5f}) {
        for (const double degrees : {10.0, 45.0}) {
            Material paint = lambertian({0.25f, 0.5f, 0});
            paint.coat = 0.75f;
            paint.coat_roughness = roughness;
            Scene scene = floor_scene(paint);
            scene.lights = {directional_light({-1, -1, 0}, glm::vec3(2))};
            RenderSettings settings = settings_of(GetParam(), 4, 4);
            settings.photons = 1000;
            const double angle = glm::radians(degrees);
            const glm::dvec3 o(-std::sin(angle), std::cos(angle), 0);
            const glm::dvec3 i = glm::normalize(glm::dvec3(1, 1, 0));
            const glm::dvec3 found =
                radiance(scene, settings, 3.0f * glm::vec3(o), {0, 0, 0}, "direct");
            const double passed = 1 - 0.75 * std::max(varnish_fresnel(o.y), varnish_fresnel(i.y));
            double coat = 0;
            if (roughness > 0) {
                const glm::dvec3 h = glm::normalize(o + i);
                const double a2 = std::pow(double(roughness), 4);
                const double f = h.y * h.y * (a2 - 1) + 1;
                const double v = 0.5 / (i.y * std::sqrt(a2 + (1 - a2) * o.y * o.y) +
                                        o.y * std::sqrt(a2 + (1 - a2) * i.y * i.y));
                coat = 0.75 * varnish_fresnel(glm::dot(o, h)) * a2 / (double(pi) * f * f) * v;
            }
            const glm::dvec3 base(0.25, 0.5, 0);
            for (int channel = 0; channel < 3; ++channel) {
                const double expected = 2 * i.y * (base[channel] * passed / double(pi) + coat);
                EXPECT_NEAR(found[channel], expected, 5e-3 * expected + 1e-3)
                    << roughness << ", " << degrees;
            }
        }
    }
}

TEST_P(Coats, SlowLayersAgreeWithThePathTracer) {
    Scene scene = box_scene(lambertian({0.6f, 0.5f, 0.4f}));
    add_quad(scene, {-0.5f, 0.95f, -0.5f}, {1, 0, 0}, {0, 0, 1},
             add_material(scene, emitter(glm::vec3(2))));
    Material paint = lambertian({0.5f, 0.1f, 0.1f});
    paint.coat = 1;
    paint.coat_roughness = 0.3f;
    add_floor(scene, 0.9f, -0.8f, add_material(scene, paint));
    Material cloth = lambertian({0.1f, 0.1f, 0.4f});
    cloth.sheen_color = {0.8f, 0.7f, 0.9f};
    cloth.sheen_roughness = 0.5f;
    add_quad(scene, {-0.9f, -0.7f, -0.6f}, {0, 1, 0}, {1, 0, -0.3f}, add_material(scene, cloth));
    Material shell;
    shell.base_color = {0.7f, 0.7f, 0.7f};
    shell.roughness = 0.5f;
    shell.film = 1;
    shell.film_thickness = 0.4f;
    shell.coat = 0.5f;
    add_sphere(scene, {0.45f, -0.4f, -0.3f}, 0.3f, 8, true, add_material(scene, shell));
    scene.cameras = {look_at({0.3f, -0.1f, 0.95f}, {0, -0.4f, -1}, 70)};
    RenderSettings reference = settings_of("path", 16, 4096);
    reference.seed = 7;
    const RenderResult& expected = render_once("coats", scene, reference);
    RenderSettings settings = settings_of(GetParam(), 16, has_map(GetParam()) ? 128 : 4096);
    settings.photons = 200'000;
    const RenderResult found = render(scene, settings);
    // The reference's caustic differs by 5 % from seed to seed.
    expect_same_layers(found, expected, 0.06, 0.15);
}

INSTANTIATE_ESTIMATES(Coats);

} // namespace
} // namespace argand::testing
