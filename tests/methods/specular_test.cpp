// Mirrors, thin walls and glass boundaries, which both methods follow from the eye.
#include "rendering.hpp"

namespace argand::testing {
namespace {

constexpr float ior = 1.5f;

/// Share of unpolarised light that a smooth boundary reflects (Fresnel); 1 for total reflection.
/// n: refractive index of the far side over that of the near side.
double fresnel(double cosine, double n) {
    const double sine = std::sqrt(1 - cosine * cosine) / n;
    if (sine >= 1) {
        return 1;
    }
    const double inside = std::sqrt(1 - sine * sine);
    const double s = (cosine - n * inside) / (cosine + n * inside);
    const double p = (n * cosine - inside) / (n * cosine + inside);
    return (s * s + p * p) / 2;
}

double schlick(double f0, double cosine) { return f0 + (1 - f0) * std::pow(1 - cosine, 5); }

class Specular : public EveryMethod {
protected:
    glm::dvec3 seen(const Scene& scene, glm::vec3 from, glm::vec3 to) {
        RenderSettings settings = settings_of(GetParam(), 8, 512);
        settings.photons = 1000;
        return radiance(scene, settings, from, to);
    }
};

TEST_P(Specular, SlabOfGlassLetsThroughWhatFresnelSays) {
    for (const float degrees : {0.0f, 30.0f, 60.0f, 80.0f}) {
        Scene scene;
        add_box(scene, {-50, -50, -0.1f}, {50, 50, 0.1f}, add_material(scene, glass(ior, true)),
                false);
        add_quad(scene, {-100, -100, -0.5f}, {200, 0, 0}, {0, 200, 0},
                 add_material(scene, emitter({1, 2, 3})));
        const double cosine = std::cos(glm::radians(degrees));
        const double r = fresnel(cosine, ior);
        // The straight path, and all paths with an even number of reflections inside.
        const double expected = (1 - r) / (1 + r);
        const glm::vec3 from(3 * std::tan(glm::radians(degrees)), 0, 3);
        const glm::dvec3 l = seen(scene, from, {0, 0, 0});
        EXPECT_NEAR(l.r, expected, 0.01) << degrees;
        EXPECT_NEAR(l.b, 3 * expected, 0.03) << degrees;
    }
}

// Entering glass divides radiance by the index squared, and leaving multiplies it again. Roulette
// must not end paths for that.
TEST_P(Specular, PathsSurviveManyPanesOfGlass) {
    Scene scene;
    const std::uint32_t pane = add_material(scene, glass(ior, true));
    double clear = 1;
    for (int i = 0; i < 4; ++i) {
        const auto z = static_cast<float>(i);
        add_box(scene, {-50, -50, z}, {50, 50, z + 0.1f}, pane, false);
        clear *= std::pow(1 - fresnel(1, ior), 2);
    }
    add_quad(scene, {-100, -100, -0.5f}, {200, 0, 0}, {0, 200, 0},
             add_material(scene, emitter(glm::vec3(1))));
    scene.cameras = {look_at({0, 0, 5}, {0, 0, 0}, 1)};
    RenderSettings settings = settings_of(GetParam(), 16, 16);
    settings.photons = 1000;
    const Image image = layer(render(scene, settings), "");
    double variance = 0;
    for (const glm::vec3& pixel : image.pixels) {
        variance += std::pow(pixel.g - mean(image).g, 2) / static_cast<double>(image.pixels.size());
    }
    EXPECT_GT(mean(image).g, clear);     // reflections between the panes add to the straight path
    EXPECT_LT(16 * variance, 2 * clear); // per sample; 8 if each entry ended half of the paths
}

TEST_P(Specular, InsideGlassRadianceIsScaledByTheIndexSquared) {
    Scene scene;
    add_box(scene, {-50, -50, -1}, {50, 50, 1}, add_material(scene, glass(ior, true)), false);
    scene.sky = glm::vec3(2);
    // Equal light comes from both sides: each side supplies what the other does not transmit.
    for (const float degrees : {0.0f, 20.0f, 38.0f}) {
        const glm::vec3 to(0.5f * std::tan(glm::radians(degrees)), 0, 0.5f);
        EXPECT_RELATIVE(seen(scene, {0, 0, 0}, to).g, 2.0 * ior * ior, 0.02) << degrees;
    }
}

TEST_P(Specular, BorderSeenFromInsideReflectsAllBeyondTheCriticalAngle) {
    for (const float degrees : {20.0f, 35.0f, 45.0f, 70.0f}) {
        Scene scene;
        add_box(scene, {-50, -50, -1}, {50, 50, 1}, add_material(scene, glass(ior, true)), false);
        add_quad(scene, {-50, -50, -0.5f}, {100, 0, 0}, {0, 100, 0},
                 add_material(scene, emitter(glm::vec3(1))));
        const float angle = glm::radians(degrees);
        const glm::vec3 to(1.0f * std::tan(angle), 0, 1);
        const double expected = fresnel(std::cos(angle), 1 / ior);
        EXPECT_NEAR(seen(scene, {0, 0, 0}, to).g, expected, 0.01) << degrees;
        if (degrees > 42) {
            EXPECT_RELATIVE(seen(scene, {0, 0, 0}, to).g, 1.0, 1e-5) << degrees;
        }
    }
}

TEST_P(Specular, ThinWallsSplitLightAndTintWhatGoesThrough) {
    for (const float degrees : {0.0f, 45.0f, 75.0f}) {
        Scene scene;
        Material wall = glass(ior, false);
        wall.base_color = {1, 0.5f, 0};
        add_quad(scene, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, add_material(scene, wall));
        add_quad(scene, {-50, -50, -1}, {100, 0, 0}, {0, 100, 0},
                 add_material(scene, emitter(glm::vec3(1))));
        add_quad(scene, {-50, -50, 9}, {0, 100, 0}, {100, 0, 0},
                 add_material(scene, emitter({0, 0, 5})));
        const glm::vec3 from(3 * std::tan(glm::radians(degrees)), 0, 3);
        const double f = schlick(0.04, std::cos(glm::radians(degrees)));
        const glm::dvec3 l = seen(scene, from, {0, 0, 0});
        EXPECT_NEAR(l.r, 1 - f, 0.01) << degrees;
        EXPECT_NEAR(l.g, 0.5 * (1 - f), 0.01) << degrees;
        EXPECT_NEAR(l.b, 5 * f, 0.05) << degrees;
    }
}

TEST_P(Specular, MirrorShowsWhatIsOppositeInItsColor) {
    for (const float degrees : {0.0f, 60.0f}) {
        Scene scene;
        add_quad(scene, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0},
                 add_material(scene, mirror({0.9f, 0.5f, 0.1f})));
        add_quad(scene, {-50, -50, 9}, {0, 100, 0}, {100, 0, 0},
                 add_material(scene, emitter(glm::vec3(2))));
        const double cosine = std::cos(glm::radians(degrees));
        const glm::dvec3 l = seen(scene, {3 * std::tan(glm::radians(degrees)), 0, 3}, {0, 0, 0});
        EXPECT_RELATIVE(l.r, 2 * schlick(0.9, cosine), 1e-3) << degrees;
        EXPECT_RELATIVE(l.g, 2 * schlick(0.5, cosine), 1e-3) << degrees;
        EXPECT_RELATIVE(l.b, 2 * schlick(0.1, cosine), 1e-3) << degrees;
    }
}

TEST_P(Specular, LitFloorInAMirrorIsDirectLight) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)));
    add_quad(scene, {-10, 0, -2}, {20, 0, 0}, {0, 10, 0}, add_material(scene, mirror()));
    scene.lights = {directional_light({0, -1, 0}, glm::vec3(1))};
    scene.cameras = {parallel_rays({0, 2, 2}, {0, 1, -2}, 1e-3f)};
    RenderSettings settings = settings_of(GetParam(), 4, 16);
    settings.photons = 20'000;
    const RenderResult result = render(scene, settings);
    EXPECT_RELATIVE(mean(layer(result, "direct")).g, 0.5 / pi, 1e-3);
    EXPECT_EQ(mean(layer(result, "indirect")).g, 0);
}

TEST_P(Specular, SunReflectedOntoTheFloorIsACaustic) {
    // A mirror at 45° reflects the sun's horizontal light straight down.
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 3);
    add_quad(scene, {-1, 1, -1}, {0, 2, 2}, {2, 0, 0}, add_material(scene, mirror()));
    scene.lights = {directional_light({0, 0, -1}, glm::vec3(1))};
    scene.cameras = {parallel_rays({0, 0.6f, 4}, {0, 0, 0}, 0.1f)};
    RenderSettings settings = settings_of(GetParam(), 8, 16);
    settings.photons = 200'000;
    const RenderResult result = render(scene, settings);
    // The path tracer cannot find the sun in a mirror; photons can.
    const double expected = has_eye_paths_only(GetParam()) ? 0 : 0.5 / pi;
    EXPECT_NEAR(mean(layer(result, "caustic")).g, expected, 0.03 * 0.5 / pi);
    EXPECT_EQ(mean(layer(result, "direct")).g, 0);
}

INSTANTIATE_ESTIMATES(Specular);

} // namespace
} // namespace argand::testing
