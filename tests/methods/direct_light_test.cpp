// Direct light on a Lambertian surface, against the integral computed by hand.
#include "rendering.hpp"

#include "scene/light_power.hpp"

namespace argand::testing {
namespace {

constexpr double albedo = 0.5;

class DirectLight : public EveryMethod {
protected:
    /// Radiance of the floor at (x, 0, z), seen obliquely from above.
    double floor_radiance(const Scene& scene, float x, float z, std::uint32_t samples = 16) {
        RenderSettings settings = settings_of(GetParam(), 4, samples);
        settings.photons = 1000;
        return radiance(scene, settings, {x + 0.3f, 4, z - 0.6f}, {x, 0, z}).g;
    }
};

TEST_P(DirectLight, PointLightOverAPlane) {
    Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
    const double height = 1.5, intensity = 7;
    scene.lights = {point_light({0, height, 0}, glm::vec3(intensity))};
    for (const float x : {0.0f, 0.5f, 1.5f, 6.0f}) {
        const double distance = std::hypot(height, double(x));
        const double expected =
            albedo / pi * intensity * (height / distance) / (distance * distance);
        EXPECT_RELATIVE(floor_radiance(scene, x, 0), expected, 1e-3) << x;
    }
}

TEST_P(DirectLight, PointLightOfTheScenesFile) {
    const Scene scene = load_asset("plane_point.gltf");
    EXPECT_RELATIVE(floor_radiance(scene, 0, 0), 0.5 / pi * 2, 1e-3);
}

TEST_P(DirectLight, LightsBelowTheFloorDoNotShineThroughIt) {
    Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
    scene.lights = {point_light({0, -1, 0}, glm::vec3(1)),
                    directional_light({0.1f, 1, 0}, glm::vec3(1))};
    EXPECT_EQ(floor_radiance(scene, 0.2f, 0), 0);
}

TEST_P(DirectLight, DirectionalLightOnAPlane) {
    Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
    const glm::vec3 direction = glm::normalize(glm::vec3(1, -2, 0.5f));
    scene.lights = {directional_light(direction, glm::vec3(3))};
    EXPECT_RELATIVE(floor_radiance(scene, 0.4f, -1), albedo / pi * 3 * -direction.y, 1e-4);
}

TEST_P(DirectLight, SpotLightOnAPlane) {
    Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
    const float inner = 0.4f, outer = 0.7f;
    scene.lights = {spot_light({0, 2, 0}, {0, -1, 0}, glm::vec3(5), inner, outer)};
    for (const float angle : {0.0f, 0.3f, 0.5f, 0.6f, 0.75f}) {
        const double cosine = std::cos(angle);
        const double ramp = (cosine - std::cos(outer)) / (std::cos(inner) - std::cos(outer));
        const double share = std::pow(std::clamp(ramp, 0.0, 1.0), 2);
        const double expected = albedo / pi * 5 * share * std::pow(cosine, 3) / 4;
        EXPECT_NEAR(floor_radiance(scene, 2 * std::tan(angle), 0), expected, 1e-3) << angle;
    }
}

// Near an emitter the light sampled by area has no bound: only a scattered ray finds it often
// enough.
TEST_P(DirectLight, EmitterThatTouchesTheFloor) {
    Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
    const std::uint32_t lamp = add_material(scene, emitter(glm::vec3(2)));
    add_quad(scene, {0, 0, 1}, {0, 0, -2}, {0, 1, 0}, lamp); // faces +x
    RenderSettings settings = settings_of(GetParam(), 32, 64);
    settings.bounces = 0;
    scene.cameras = {look_at({0.2f, 0.6f, 0}, {0.05f, 0, 0}, 12)};
    const Image found = layer(render(scene, settings), "direct");
    settings.seed = 1;
    settings.samples = 1024;
    settings.method = "path";
    const RenderResult& truth = render_once("emitter on the floor", scene, settings);
    EXPECT_LT(compare(found, layer(truth, "direct")).rel_mse, 0.01);
}

TEST_P(DirectLight, LightsAddUp) {
    Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
    double expected = 0;
    for (int i = 1; i <= 5; ++i) {
        scene.lights.push_back(point_light({0, i, 0}, glm::vec3(i * i * i)));
        expected += albedo / pi * i;
    }
    // Each sample chooses one light in proportion to its power, not to the light that arrives.
    EXPECT_RELATIVE(floor_radiance(scene, 0, 0, 4096), expected, 0.02);
}

/// Irradiance of the floor at (x, 0, 0) from a square that faces down, by the midpoint rule.
double irradiance(double x, double half, double height, double radiance) {
    constexpr int n = 400;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double dx = half * ((2.0 * i + 1) / n - 1) - x;
            const double dz = half * ((2.0 * j + 1) / n - 1);
            const double d2 = dx * dx + dz * dz + height * height;
            sum += height * height / (d2 * d2);
        }
    }
    return radiance * sum * 4 * half * half / (n * n);
}

TEST_P(DirectLight, AreaLightIsTheIntegralOverItsArea) {
    for (const double height : {0.1, 1.0}) {
        Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
        const auto y = static_cast<float>(height);
        add_quad(scene, {-0.5f, y, -0.5f}, {1, 0, 0}, {0, 0, 1},
                 add_material(scene, emitter(glm::vec3(4))));
        for (const float x : {0.8f, 2.0f}) {
            EXPECT_RELATIVE(floor_radiance(scene, x, 0, 8192),
                            albedo / pi * irradiance(x, 0.5, height, 4), 0.02)
                << height << ", " << x;
        }
    }
}

TEST_P(DirectLight, EmittersShineFromTheirFrontOrFromBothSides) {
    for (const bool double_sided : {false, true}) {
        Scene scene;
        Material light = emitter({1, 2, 3});
        light.double_sided = double_sided;
        add_floor(scene, 1, 0, add_material(scene, light));
        const RenderSettings settings = settings_of(GetParam(), 4, 4);
        EXPECT_EQ(radiance(scene, settings, {0.1f, 1, 0}, {0, 0, 0}), glm::dvec3(1, 2, 3));
        EXPECT_EQ(radiance(scene, settings, {0.1f, -1, 0}, {0, 0, 0}),
                  double_sided ? glm::dvec3(1, 2, 3) : glm::dvec3(0));
        // Its light on a wall above and on one below.
        const std::uint32_t wall = add_material(scene, lambertian(glm::vec3(albedo)));
        add_floor(scene, 4, 1, wall);
        add_floor(scene, 4, -1, wall);
        const double expected = albedo / pi * irradiance(0, 1, 1, 2);
        const RenderSettings many = settings_of(GetParam(), 4, 4096);
        EXPECT_RELATIVE(radiance(scene, many, {2, 0.5f, 0}, {0, 1, 0}, "direct").g, expected, 0.03);
        const double below = radiance(scene, many, {2, -0.5f, 0}, {0, -1, 0}, "direct").g;
        EXPECT_NEAR(below, double_sided ? expected : 0, 0.03 * expected);
    }
}

TEST_P(DirectLight, UniformSkyOverAPlane) {
    Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
    scene.sky = glm::vec3(2);
    EXPECT_RELATIVE(floor_radiance(scene, 0, 0, 8192), albedo * 2, 0.02);
}

TEST_P(DirectLight, IsInTheDirectLayerAlone) {
    Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
    scene.lights = {point_light({0, 1, 0}, glm::vec3(1))};
    scene.sky = glm::vec3(0.1f);
    scene.cameras = {look_at({0, 3, 3}, {0, 0, 0})};
    const RenderResult result = render(scene, settings_of(GetParam(), 8, 8));
    EXPECT_GT(mean(layer(result, "direct")).g, 0);
    EXPECT_EQ(mean(layer(result, "indirect")).g, 0);
    EXPECT_EQ(mean(layer(result, "caustic")).g, 0);
}

INSTANTIATE_ESTIMATES(DirectLight);

} // namespace
} // namespace argand::testing
