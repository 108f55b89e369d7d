// Rough transmission and refraction (KHR_materials_transmission, _volume), rendered by every
// method.
#include "rendering.hpp"

namespace argand::testing {
namespace {

Material frosted(float roughness, bool solid) {
    Material m = glass(1.5f, solid);
    m.roughness = roughness;
    return m;
}

/// GGX's distribution of normals [1/sr] over the cosine of the half vector.
double distribution(double alpha, double cosine) {
    const double f = cosine * cosine * (alpha * alpha - 1) + 1;
    return alpha * alpha / (std::numbers::pi * f * f);
}

/// cos θ (1 + 2 Λ), see ggx.h.
double masked(double alpha, double cosine) {
    return std::sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine);
}

class RoughGlass : public EveryMethod {};

/// Radiance over irradiance of a sun straight above a rough solid, seen from within at an angle
/// (Walter's equation 21).
double refracted(double alpha, double eta, double angle) {
    const glm::dvec3 o(std::sin(angle), -std::cos(angle), 0), i(0, 1, 0);
    // From within: the index on the sun's side over that on the eye's is 1 / eta.
    const glm::dvec3 h = glm::normalize(eta * o + i);
    const double c = std::abs(glm::dot(o, h)), t = std::abs(glm::dot(i, h));
    const double s = (eta * c - t) / (eta * c + t), p = (c - eta * t) / (c + eta * t);
    const double passed = 1 - 0.5 * (s * s + p * p);
    const double co = -o.y, ci = 1;
    const double visibility = 0.5 / (ci * masked(alpha, co) + co * masked(alpha, ci));
    const double sum = glm::length(eta * o + i);
    return 4 * eta * eta * visibility * distribution(alpha, std::abs(h.y)) * passed * c * t /
           (sum * sum);
}

TEST_P(RoughGlass, RefractsASunAsTheFormulaSays) {
    for (const double degrees : {0.0, 20.0, 35.0}) {
        SCOPED_TRACE(degrees);
        const double angle = glm::radians(degrees);
        const glm::vec3 from(3 * std::sin(angle), -3 * std::cos(angle), 0);
        for (const float dispersion : {0.0f, 4.0f}) {
            Material glass = frosted(0.6f, true);
            glass.dispersion = dispersion; // 4: indices of 1.45, 1.5 and 1.55
            Scene scene = floor_scene(glass);
            scene.lights = {directional_light({0, -1, 0}, glm::vec3(2))};
            RenderSettings settings = settings_of(GetParam(), 4, dispersion > 0 ? 4096 : 4);
            settings.photons = 1000;
            const glm::dvec3 found = radiance(scene, settings, from, {0, 0, 0}, "direct");
            for (int channel = 0; channel < 3; ++channel) {
                const double eta = 1.5 + 0.0125 * double(dispersion) * (channel - 1);
                const double expected = 2 * refracted(0.36, eta, angle);
                // With dispersion a third of the paths has each colour.
                EXPECT_NEAR(found[channel], expected, (dispersion > 0 ? 0.025 : 5e-3) * expected);
            }
        }
    }
}

// A thin wall under a uniform sky is as bright as the sky, less what its colour takes: light
// samples and scattered rays share the light.
TEST_P(RoughGlass, AThinWallLetsTheSkyThrough) {
    for (const float roughness : {0.2f, 0.7f}) {
        Scene scene = floor_scene(frosted(roughness, false));
        scene.materials.back().base_color = {1, 0.5f, 0.25f};
        scene.sky = glm::vec3(1);
        RenderSettings settings = settings_of(GetParam(), 16, 64);
        settings.photons = 1000;
        const glm::dvec3 found = radiance(scene, settings, {1, -3, 0}, {0, 0, 0});
        // Nothing lies below the floor but the sky, which the layer reflects.
        const double reflected = 0.045; // of glass at 18 degrees, within 0.005
        EXPECT_NEAR(found.r, 1, 0.02) << roughness;
        EXPECT_NEAR(found.g, 0.5 * (1 - reflected) + reflected, 0.02) << roughness;
        EXPECT_NEAR(found.b, 0.25 * (1 - reflected) + reflected, 0.02) << roughness;
    }
}

/// A room whose lamp is seen through, and whose floor is lit through, frosted glass.
Scene frosted_room() {
    Scene scene = box_scene(lambertian({0.6f, 0.5f, 0.4f}));
    add_quad(scene, {-0.5f, 0.95f, -0.5f}, {1, 0, 0}, {0, 0, 1},
             add_material(scene, emitter(glm::vec3(2))));
    Material amber = frosted(0.45f, true);
    amber.absorption = {0.2f, 1, 2};
    amber.dispersion = 3;
    add_sphere(scene, {0.35f, -0.4f, -0.2f}, 0.4f, 12, true, add_material(scene, amber));
    Material pane = frosted(0.4f, false);
    pane.base_color = {0.5f, 0.8f, 0.9f};
    add_quad(scene, {-0.8f, -0.6f, 0.2f}, {0.7f, 0, -0.3f}, {0, 0.9f, 0},
             add_material(scene, pane));
    scene.cameras = {look_at({0.1f, -0.1f, 0.95f}, {0, -0.3f, -1}, 70)};
    return scene;
}

TEST_P(RoughGlass, SlowLayersAgreeWithThePathTracer) {
    const Scene scene = frosted_room();
    RenderSettings reference = settings_of("path", 16, 4096);
    reference.seed = 7;
    const RenderResult& expected = render_once("frosted room", scene, reference);
    RenderSettings settings = settings_of(GetParam(), 16, has_map(GetParam()) ? 128 : 4096);
    settings.photons = 200'000;
    const RenderResult found = render(scene, settings);
    // The reference's caustic differs by 5 % from seed to seed.
    expect_same_layers(found, expected, 0.06, 0.15);
    EXPECT_GT(mean(layer(expected, "caustic")).g, 0.05 * mean(layer(expected, "direct")).g);
}

INSTANTIATE_ESTIMATES(RoughGlass);

} // namespace
} // namespace argand::testing
