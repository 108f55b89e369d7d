// Light from a sky's picture and its sun: against closed formulas, the uniform sky and directional
// lights, by every method and layer by layer.
#include "rendering.hpp"

#include "scene/environment_summary.hpp"

namespace argand::testing {
namespace {

constexpr double albedo = 0.5;

Environment environment(int width, int height, std::vector<glm::vec3> texels) {
    Environment sky;
    sky.name = "test";
    sky.picture = make_sky_picture(width, height, std::move(texels), sky.name);
    return sky;
}

/// A picture of a function of the sine of the height above the horizon.
template <class Radiance> Environment sky_by_height(int height, const Radiance& radiance) {
    std::vector<glm::vec3> texels;
    for (int row = 0; row < height; ++row) {
        texels.emplace_back(
            static_cast<float>(radiance(std::cos(std::numbers::pi * (row + 0.5) / height))));
    }
    return environment(1, height, std::move(texels));
}

/// Black but for one texel.
Environment one_bright_texel(int width, int height, int column, int row, glm::vec3 radiance) {
    std::vector<glm::vec3> texels(static_cast<std::size_t>(width * height), glm::vec3(0));
    texels[static_cast<std::size_t>(row * width + column)] = radiance;
    return environment(width, height, std::move(texels));
}

glm::vec3 direction_of_texel(int width, int height, int column, int row) {
    const double turn = 2 * std::numbers::pi * ((column + 0.5) / width - 0.5);
    const double angle = std::numbers::pi * (row + 0.5) / height;
    return {std::sin(angle) * std::cos(turn), std::cos(angle), std::sin(angle) * std::sin(turn)};
}

/// Its directional light.
Light light_of_texel(const Environment& sky, int column, int row) {
    return directional_light(
        -direction_of_texel(sky.picture->width, sky.picture->height, column, row),
        glm::vec3(mean_radiance(sky) * 4.0 * std::numbers::pi));
}

/// The yard before a wall, with a glass ball and a rough metal block.
Scene yard() {
    Scene scene = floor_scene(lambertian({0.6f, 0.5f, 0.4f}), 2);
    scene.name = "yard";
    add_quad(scene, {-2, 0, -2}, {4, 0, 0}, {0, 2, 0}, 0);
    add_quad(scene, {-2, 0, 2}, {0, 0, -4}, {0, 2, 0}, 0);
    add_sphere(scene, {0.5f, 0.5f, 0.4f}, 0.5f, 12, true, add_material(scene, glass(1.5f, true)));
    Material steel;
    steel.roughness = 0.5f;
    add_box(scene, {-1.2f, 0, -1}, {-0.5f, 0.8f, -0.4f}, add_material(scene, steel), false);
    scene.cameras = {look_at({2.2f, 2, 3.2f}, {-0.2f, 0.4f, -0.2f}, 45)};
    return scene;
}

class SkyPictures : public EveryMethod {
protected:
    /// Radiance of the floor at its middle, seen obliquely from above.
    double floor_radiance(const Scene& scene, std::uint32_t samples) {
        RenderSettings settings = settings_of(GetParam(), 4, samples);
        settings.photons = 1000;
        return radiance(scene, settings, {0.3f, 4, -0.6f}, {0, 0, 0}).g;
    }

    double floor_radiance(const Environment& sky, std::uint32_t samples) {
        Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
        scene.environment = sky;
        return floor_radiance(scene, samples);
    }
};

TEST_P(SkyPictures, UniformPictureIsTheUniformSky) {
    EXPECT_RELATIVE(floor_radiance(environment(1, 1, {glm::vec3(2)}), 8192), albedo * 2, 0.01);
    EXPECT_RELATIVE(
        floor_radiance(environment(5, 3, std::vector<glm::vec3>(15, glm::vec3(2))), 8192),
        albedo * 2, 0.01);
    // Seen directly, it has no noise.
    Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
    scene.environment = environment(3, 2, std::vector<glm::vec3>(6, glm::vec3(2, 1, 0.5f)));
    scene.environment->strength = 3;
    const glm::dvec3 seen = radiance(scene, settings_of(GetParam(), 4, 4), {0, 1, 0}, {0.3f, 2, 1});
    EXPECT_RELATIVE(seen.r, 6, 1e-5);
    EXPECT_RELATIVE(seen.g, 3, 1e-5);
    EXPECT_RELATIVE(seen.b, 1.5, 1e-5);
}

// Irradiance of the floor is 2 pi times the integral of L(y) y over 0 < y < 1.
TEST_P(SkyPictures, IrradianceOfKnownPictures) {
    // L = y: 2 pi / 3. The row at the horizon is not: it is linear from y to 0 below the horizon.
    EXPECT_RELATIVE(
        floor_radiance(sky_by_height(64, [](double y) { return std::max(y, 0.0); }), 4096),
        albedo * 2.0 / 3, 0.01);
    // The upper half white.
    EXPECT_RELATIVE(
        floor_radiance(sky_by_height(256, [](double y) { return y > 0 ? 1 : 0; }), 4096), albedo,
        0.01);
    // The lower half white: the row at the horizon alone reaches the floor.
    EXPECT_LT(floor_radiance(sky_by_height(256, [](double y) { return y > 0 ? 0 : 1; }), 4096),
              1e-3);
    // The eastern half white, turned by any angle.
    std::vector<glm::vec3> texels(8 * 2, glm::vec3(0));
    for (std::size_t i = 0; i < texels.size(); ++i) {
        texels[i] = glm::vec3(i % 8 < 4 ? 0 : 1);
    }
    for (const double rotation : {0.0, 65.0}) {
        Environment half = environment(8, 2, texels);
        half.rotation = rotation;
        EXPECT_RELATIVE(floor_radiance(half, 4096), albedo / 2, 0.01) << rotation;
    }
}

TEST_P(SkyPictures, BrightTexelIsADirectionalLight) {
    const Environment sky = one_bright_texel(512, 256, 40, 60, {1e5f, 5e4f, 2e5f});
    const Light sun = light_of_texel(sky, 40, 60);
    // Without bounces: the cosine varies over the texel by a part in a thousand.
    EXPECT_RELATIVE(floor_radiance(sky, 256), albedo / pi * sun.intensity.g * -sun.direction.y,
                    2e-3);
    // Beside a dim sky.
    std::vector<glm::vec3> texels = sky.picture->texels;
    for (glm::vec3& texel : texels) {
        texel += glm::vec3(1e-3f);
    }
    EXPECT_RELATIVE(floor_radiance(environment(512, 256, texels), 1024),
                    albedo * 1e-3 + albedo / pi * sun.intensity.g * -sun.direction.y, 1e-2);
}

TEST_P(SkyPictures, SunIsADirectionalLight) {
    Environment sky = environment(1, 1, {glm::vec3(0)});
    sky.sun = Sun{.towards = glm::vec3(direction_of(SkyPlace{40, 70})),
                  .radius = 0.00465f,
                  .radiance = glm::vec3(1e6f, 2e6f, 1e6f)};
    const double expected = albedo / pi * illuminance_of_sun(sky).g * sky.sun->towards.y;
    EXPECT_RELATIVE(floor_radiance(sky, 256), expected, 1e-3);
    sky.rotation = 123;
    EXPECT_RELATIVE(floor_radiance(sky, 256), expected, 1e-3);
    // Seen in its direction, after the rotation.
    Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
    scene.environment = sky;
    const glm::vec3 towards(rotated(sky, glm::dvec3(sky.sun->towards)));
    const RenderSettings settings = settings_of(GetParam(), 4, 4);
    EXPECT_RELATIVE(radiance(scene, settings, {0, 1, 0}, glm::vec3(0, 1, 0) + towards).g, 2e6,
                    1e-4);
    EXPECT_EQ(radiance(scene, settings, {0, 1, 0}, glm::vec3(0, 1, 0) + sky.sun->towards).g, 0);
}

TEST_P(SkyPictures, BlackPicturesAreNoLight) {
    Scene scene = floor_scene(lambertian(glm::vec3(albedo)));
    scene.environment = environment(4, 2, std::vector<glm::vec3>(8, glm::vec3(0)));
    EXPECT_EQ(floor_radiance(scene, 16), 0);
    scene.environment->strength = 0;
    EXPECT_EQ(floor_radiance(scene, 16), 0);
    scene.lights = {point_light({0, 1, 0}, glm::vec3(1))};
    EXPECT_RELATIVE(floor_radiance(scene, 16), albedo / pi, 1e-3);
}

/// Mean radiance of each layer over seeds.
std::map<std::string, glm::dvec3> layers_of(Device& device, const Scene& scene,
                                            const RenderSettings& settings, int seeds) {
    std::map<std::string, glm::dvec3> sums;
    for (int seed = 0; seed < seeds; ++seed) {
        RenderSettings one = settings;
        one.seed = static_cast<std::uint32_t>(seed) + 20;
        const RenderResult found = render(device, scene, one);
        EXPECT_EQ(found.statistics.non_finite, 0u);
        for (const char* name : {"direct", "indirect", "caustic"}) {
            sums[name] += mean(layer(found, name)) / double(seeds);
        }
    }
    return sums;
}

class SkyLayers : public RenderTest {
protected:
    static RenderSettings settings(const std::string& method) {
        RenderSettings settings = settings_of(method, 16, method == "path" ? 1024 : 128);
        settings.photons = 100'000;
        return settings;
    }

    /// Expects the same layers of two scenes, by two methods.
    void expect_same(const Scene& scene, const std::string& method, const Scene& expected,
                     const std::string& as, const std::map<std::string, double>& tolerances) {
        const auto truth = layers_of(device(), expected, settings(as), 2);
        const auto found = layers_of(device(), scene, settings(method), 2);
        for (const auto& [name, tolerance] : tolerances) {
            EXPECT_RELATIVE(found.at(name).g, truth.at(name).g, tolerance)
                << method << ", " << name;
        }
    }

    /// Expects the layers of `path` in the yard under a picture that is brighter higher up.
    void expect_as_path_under_a_gradient(const std::string& method) {
        Scene scene = yard();
        scene.environment = sky_by_height(64, [](double y) { return y > 0 ? 0.2 + y : 0.1; });
        expect_same(scene, method, scene, "path",
                    {{"direct", 0.01}, {"indirect", 0.03}, {"caustic", 0.06}});
    }
};

TEST_F(SkyLayers, MethodsAgreeOnEveryLayer) { expect_as_path_under_a_gradient("footprints"); }

TEST_F(SkyLayers, SlowPhotonsAgreeOnEveryLayer) { expect_as_path_under_a_gradient("photons"); }

// A uniform picture in the yard is the uniform sky in it.
TEST_F(SkyLayers, SlowUniformPictureIsTheUniformSky) {
    Scene uniform = yard();
    uniform.sky = glm::vec3(1, 0.8f, 0.6f);
    Scene scene = yard();
    scene.environment = environment(1, 1, {*uniform.sky});
    for (const char* method : {"path", "photons", "footprints"}) {
        expect_same(scene, method, uniform, method,
                    {{"direct", 0.01}, {"indirect", 0.05}, {"caustic", 0.1}});
    }
}

// A sun in a picture casts the light and the caustic of a directional light.
TEST_F(SkyLayers, SlowBrightTexelIsADirectionalLight) {
    Scene scene = yard();
    scene.environment = one_bright_texel(2048, 1024, 1500, 300, glm::vec3(2e5f));
    Scene with_light = yard();
    with_light.lights = {light_of_texel(*scene.environment, 1500, 300)};
    for (const char* method : {"photons", "footprints"}) {
        expect_same(scene, method, with_light, method,
                    {{"direct", 0.01}, {"indirect", 0.03}, {"caustic", 0.05}});
    }
    // Light without extent behind glass is invisible to `path`.
    expect_same(scene, "path", with_light, "path", {{"direct", 0.01}, {"indirect", 0.03}});
}

INSTANTIATE_ESTIMATES(SkyPictures);

} // namespace
} // namespace argand::testing
