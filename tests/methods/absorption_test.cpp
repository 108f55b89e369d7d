// Solids that absorb light (KHR_materials_volume), and unlit surfaces, against closed forms.
#include "rendering.hpp"

namespace argand::testing {
namespace {

const glm::vec3 absorption{0.3f, 1, 0};

/// A solid without reflection, so that what it lets through is known.
Material fog() {
    Material m = glass(1, true);
    m.absorption = absorption;
    return m;
}

class Absorption : public EveryMethod {
protected:
    RenderSettings settings(std::uint64_t photons) const {
        RenderSettings s = settings_of(GetParam(), 8, 16);
        s.photons = photons;
        return s;
    }
};

/// Part of the light that is left after a distance.
glm::dvec3 left_after(double distance) { return glm::exp(-glm::dvec3(absorption) * distance); }

TEST_P(Absorption, DimsWhatIsSeenThroughASlab) {
    for (const double degrees : {0.0, 60.0, 85.0}) {
        SCOPED_TRACE(degrees);
        Scene scene;
        add_box(scene, {-40, -40, -1.5f}, {40, 40, 0}, add_material(scene, fog()), false);
        add_quad(scene, {-200, -200, -3}, {400, 0, 0}, {0, 400, 0},
                 add_material(scene, emitter({1, 2, 3})));
        const glm::vec3 from(3 * std::tan(glm::radians(float(degrees))), 0, 3);
        const glm::dvec3 expected =
            glm::dvec3(1, 2, 3) * left_after(1.5 / std::cos(glm::radians(degrees)));
        const glm::dvec3 seen = radiance(scene, settings(1000), from, {0, 0, 0}, "direct");
        // From inside the slab, where no surface was crossed.
        const glm::dvec3 inside =
            radiance(scene, settings(1000), {0, 0, -0.5f}, {0, 0, -2}, "direct");
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(seen[channel], expected[channel], 3e-3 * expected[channel] + 1e-6);
            EXPECT_NEAR(inside[channel], (glm::dvec3(1, 2, 3) * left_after(1))[channel], 1e-3);
        }
    }
}

// The floor lies inside the solid: its light is absorbed on the way in, and on the way out.
TEST_P(Absorption, DimsLightOnItsWayToWhatIsInside) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 3);
    add_floor(scene, 4, 0.7f, add_material(scene, fog()));
    scene.lights = {directional_light({0, -1, 0}, glm::vec3(1))};
    scene.cameras = {parallel_rays({0, 3, 4}, {0, 0, 0}, 0.1f)};
    const RenderResult result = render(scene, settings(200'000));
    const glm::dvec3 found = mean(layer(result, "caustic"));
    const double eye = 0.7 * 5 / 3; // the camera looks down at a slope of 3/4
    for (int channel = 0; channel < 3; ++channel) {
        const double expected = has_map(GetParam())
                                    ? 0.5 / pi * (left_after(0.7) * left_after(eye))[channel]
                                    : 0; // paths cannot hit the sun
        EXPECT_NEAR(found[channel], expected, 0.03 * 0.5 / pi) << channel;
    }
}

// A lamp and what it lights, inside one solid.
TEST_P(Absorption, DimsShadowRays) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 3);
    add_floor(scene, 4, 3, add_material(scene, fog()));
    scene.lights = {point_light({0, 2, 0}, glm::vec3(4))};
    scene.cameras = {parallel_rays({0, 3.5f, 0.01f}, {0, 0, 0}, 0.01f)};
    const glm::dvec3 found = mean(layer(render(scene, settings(1000)), "direct"));
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(found[channel], 0.5 / pi * (left_after(2) * left_after(3))[channel],
                    0.001 * 0.5 / pi);
    }
}

TEST_P(Absorption, KeepsCountOfTheFlux) {
    if (!has_map(GetParam())) {
        return; // it has no photons
    }
    Scene scene = floor_scene(lambertian(glm::vec3(0)), 40);
    add_floor(scene, 4, 0.7f, add_material(scene, fog()));
    scene.lights = {point_light({0, 2, 0}, glm::vec3(4))};
    scene.cameras = {parallel_rays({0, 3, 4}, {0, 0, 0}, 0.1f)};
    RenderSettings s = settings(20'000);
    s.bounces = 8;
    const auto flux = render(scene, s).statistics.flux;
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_EQ(flux.emitted[channel], flux.absorbed[channel] + flux.escaped[channel] +
                                             flux.cut[channel] + flux.lost[channel]);
        EXPECT_GT(flux.absorbed[channel], 0);
    }
}

TEST_P(Absorption, UnlitSurfacesShowTheirBaseColour) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 3);
    Material label = lambertian({0.2f, 0.5f, 1});
    label.unlit = true;
    label.coverage = 0.5f;
    add_floor(scene, 3, 0.2f, add_material(scene, label));
    for (const float power : {0.0f, 1.0f}) {
        scene.lights = {directional_light({0, -1, 0}, glm::vec3(power))};
        scene.cameras = {parallel_rays({0, 3, 4}, {0, 0, 0}, 0.1f)};
        const RenderResult result = render(scene, settings(400'000));
        const glm::dvec3 direct = mean(layer(result, "direct"));
        // Half of the floor is seen, in half of the light.
        const double floor = 0.5 * 0.5 * 0.5 / pi * double(power);
        EXPECT_NEAR(direct.r, 0.1 + floor, 1e-3);
        EXPECT_NEAR(direct.g, 0.25 + floor, 1e-3);
        EXPECT_NEAR(direct.b, 0.5 + floor, 1e-3);
        EXPECT_EQ(mean(layer(result, "indirect")), glm::dvec3(0)); // it lights nothing
        EXPECT_EQ(mean(layer(result, "caustic")), glm::dvec3(0));
    }
}

INSTANTIATE_ESTIMATES(Absorption);

} // namespace
} // namespace argand::testing
