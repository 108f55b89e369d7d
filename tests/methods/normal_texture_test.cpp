// Surfaces whose normals texels turn, rendered by every method.
#include "rendering.hpp"
#include "scene/tangents.hpp"
#include "textured.hpp"

namespace argand::testing {
namespace {

class NormalTexture : public EveryMethod {};

/// A texel that turns the normal towards these parts of the tangent and of the bitangent.
std::uint32_t turned(double x, double y) {
    const auto code = [](double part) { return int(std::lround(128 + 127 * part)); };
    return texel(code(x), code(y), code(std::sqrt(1 - x * x - y * y)));
}

/// The normal of a floor that faces up, with u along x and v along z, that a texel makes.
glm::dvec3 normal_of(std::uint32_t texel) {
    const auto t = std::bit_cast<glm::u8vec4>(texel);
    const glm::dvec3 slope = (glm::dvec3(t) - 128.0) / 127.0;
    return glm::normalize(glm::dvec3(slope.x, slope.z, -slope.y));
}

Scene turned_floor(const std::vector<std::uint32_t>& texels, std::uint32_t width) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)));
    add_texture(scene, 0, material_normal_texture, width, texels, true);
    project(scene, 2);
    add_tangents(scene);
    return scene;
}

TEST_P(NormalTexture, LightsBySlopes) {
    const std::vector<std::uint32_t> texels{turned(0.5, 0), turned(0, 0.6), turned(-0.7, -0.5),
                                            turned(0, 0)};
    Scene scene = turned_floor(texels, 2);
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(0.3, 1, -0.4));
    scene.lights = {directional_light(-glm::vec3(to_light), glm::vec3(float(pi)))};
    RenderSettings settings = settings_of(GetParam(), 4, 1);
    settings.photons = 1000;
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 to(0.5f + float(i % 2), 0, 0.5f + float(i / 2));
        // Also seen from beneath the horizon of the turned normal: nothing is black.
        for (const glm::vec3 from :
             {glm::vec3(0.1f, 3, 0.2f), glm::vec3(-8, 1, 6), glm::vec3(8, 1, -6)}) {
            const double expected =
                0.5 * std::max(0.0, glm::dot(normal_of(texels[std::size_t(i)]), to_light));
            EXPECT_NEAR(radiance(scene, settings, to + from, to, "direct").g, expected, 2e-4)
                << i << ", from " << from.x;
        }
    }
}

TEST_P(NormalTexture, OfOneFlatTexelChangesNothing) {
    Scene scene = box_scene(lambertian({0.6f, 0.5f, 0.4f}));
    add_quad(scene, {-0.5f, 0.95f, -0.5f}, {1, 0, 0}, {0, 0, 1},
             add_material(scene, emitter(glm::vec3(2))));
    scene.cameras = {look_at({0.3f, -0.1f, 0.95f}, {0, -0.4f, -1}, 70)};
    RenderSettings settings = settings_of(GetParam(), 8, 4);
    settings.photons = 5000;
    const RenderResult without = render(scene, settings);
    add_texture(scene, 0, material_normal_texture, 1, {texel(128, 128, 255)}, true);
    project(scene, 1);
    add_tangents(scene);
    expect_same_layers(render(scene, settings), without, 1e-4);
}

// Steep slopes, so that paths meet many of them from beneath their horizon.
TEST_P(NormalTexture, SlowLayersAgreeWithThePathTracer) {
    Scene scene = box_scene(lambertian({0.8f, 0.7f, 0.6f}));
    std::vector<std::uint32_t> texels;
    for (int i = 0; i < 16; ++i) {
        texels.push_back(turned(0.75 * std::sin(2.4 * i), 0.75 * std::cos(2.4 * i) * (i % 3) / 2));
    }
    add_texture(scene, 0, material_normal_texture, 4, texels, true);
    add_quad(scene, {-0.5f, 0.95f, -0.5f}, {1, 0, 0}, {0, 0, 1},
             add_material(scene, emitter(glm::vec3(2))));
    project_obliquely(scene);
    add_tangents(scene);
    scene.cameras = {look_at({0.3f, -0.1f, 0.95f}, {0, -0.4f, -1}, 70)};
    RenderSettings reference = settings_of("path", 16, 2048);
    reference.seed = 7;
    const RenderResult& expected = render_once("slopes", scene, reference);
    RenderSettings settings = settings_of(GetParam(), 16, has_map(GetParam()) ? 128 : 2048);
    settings.photons = 400'000;
    const RenderResult found = render(scene, settings);
    for (const char* name : {"direct", "indirect"}) {
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_RELATIVE(mean(layer(found, name))[channel], mean(layer(expected, name))[channel],
                            0.03)
                << name << ", " << channel;
        }
    }
}

INSTANTIATE_ESTIMATES(NormalTexture);

} // namespace
} // namespace argand::testing
