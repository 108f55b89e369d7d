// Scenes with uniform light, where the sum over all bounces is known.
#include "rendering.hpp"

namespace argand::testing {
namespace {

class Energy : public EveryMethod {
protected:
    RenderSettings settings(std::uint32_t samples) const {
        RenderSettings settings = settings_of(GetParam(), 16, samples);
        settings.photons = 100'000;
        return settings;
    }
};

TEST_P(Energy, FurnaceOfTheScenesFile) {
    const RenderResult result = render(load_asset("furnace.glb"), settings(1024));
    const Image& image = layer(result, "");
    const glm::dvec3 all = mean(image);
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(all[channel], 1, 0.01);
        EXPECT_NEAR(mean(image, 6, 6, 10, 10)[channel], 1, 0.05);
    }
}

TEST_P(Energy, FurnaceWithInterreflection) {
    Scene scene;
    const std::uint32_t white = add_material(scene, lambertian(glm::vec3(1)));
    add_floor(scene, 1, 0, white);
    add_quad(scene, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, white);
    scene.sky = glm::vec3(1, 2, 0.5f);
    // The view shows the floor, half a metre away from its edges.
    scene.cameras = {parallel_rays({0, 4, 4}, {0, 0, 0}, 0.3f)};
    const RenderResult result = render(scene, settings(512));
    const glm::dvec3 all = mean(layer(result, ""));
    const double tolerance = has_map(GetParam()) ? 0.03 : 0.01;
    EXPECT_RELATIVE(all.r, 1.0, tolerance);
    EXPECT_RELATIVE(all.g, 2.0, tolerance);
    EXPECT_RELATIVE(all.b, 0.5, tolerance);
    EXPECT_GT(mean(layer(result, "indirect")).r, 0.05);
}

TEST_P(Energy, ClosedBoxIsAGeometricSeries) {
    const glm::dvec3 reflected(0.5, 0.8, 0.2);
    const glm::dvec3 emitted(0.25, 0.1, 1);
    const Scene scene = box_scene(emitter(emitted, reflected));
    const RenderResult result = render(scene, settings(256));
    // The view shows the middle of a wall, away from its edges, where the estimate is biased.
    const glm::dvec3 all = mean(layer(result, ""));
    const glm::dvec3 direct = mean(layer(result, "direct"));
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_RELATIVE(all[channel], emitted[channel] / (1 - reflected[channel]), 0.03) << channel;
        EXPECT_RELATIVE(direct[channel], emitted[channel] * (1 + reflected[channel]), 0.02)
            << channel;
    }
    EXPECT_EQ(mean(layer(result, "caustic")), glm::dvec3(0));
}

TEST_P(Energy, ClosedBoxOfTheScenesFile) {
    Scene scene = load_asset("closed_box.gltf");
    const RenderResult result = render(scene, settings(128));
    // The view shows a corner, where density estimation loses light and path tracing does not.
    EXPECT_NEAR(mean(layer(result, "")).g, 0.5, has_map(GetParam()) ? 0.05 : 0.005);
}

TEST_P(Energy, EachBounceAddsItsTerm) {
    const double reflected = 0.6;
    const Scene scene = box_scene(emitter(glm::vec3(1), glm::vec3(reflected)));
    double expected = 1;
    for (std::uint32_t bounces = 0; bounces <= 3; ++bounces) {
        RenderSettings limited = settings(128);
        limited.bounces = bounces;
        expected += std::pow(reflected, bounces + 1);
        EXPECT_RELATIVE(mean(layer(render(scene, limited), "")).g, expected, 0.02) << bounces;
    }
}

TEST_P(Energy, BlackWallsReflectNothing) {
    const RenderResult result = render(box_scene(emitter(glm::vec3(1))), settings(4));
    EXPECT_EQ(mean(layer(result, "")), glm::dvec3(1));
    EXPECT_EQ(mean(layer(result, "indirect")), glm::dvec3(0));
}

INSTANTIATE_ESTIMATES(Energy);

} // namespace
} // namespace argand::testing
