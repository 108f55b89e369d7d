// Textured surfaces and vertices with colours, rendered by every method.
#include "rendering.hpp"
#include "textured.hpp"

#include <bit>

namespace argand::testing {
namespace {

class Textured : public EveryMethod {};

TEST_P(Textured, ReflectsTheTexelsColour) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f, 1, 1)));
    const std::vector<std::uint32_t> texels{texel(255, 0, 10), texel(0, 128, 0), texel(0, 30, 200),
                                            texel(90, 90, 90)};
    add_texture(scene, 0, material_base_color_texture, 2, texels, true);
    project(scene, 2);
    scene.lights = {directional_light({0, -1, 0}, glm::vec3(float(pi)))};
    RenderSettings settings = settings_of(GetParam(), 4, 1);
    settings.photons = 1000;
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 to(0.5f + float(i % 2), 0, 0.5f + float(i / 2));
        const glm::dvec3 l = radiance(scene, settings, to + glm::vec3(0.1f, 3, 0.2f), to, "direct");
        const auto color = std::bit_cast<glm::u8vec4>(texels[std::size_t(i)]);
        EXPECT_NEAR(l.r, 0.5 * linear(color.r), 1e-5) << i;
        EXPECT_NEAR(l.g, linear(color.g), 1e-5) << i;
        EXPECT_NEAR(l.b, linear(color.b), 1e-5) << i;
    }
}

// A globe, whose image has a texel for every 45 degrees of longitude and latitude. The light comes
// from the eye.
TEST_P(Textured, SphereReflectsTheTexelsColour) {
    Scene scene;
    add_sphere(scene, glm::vec3(0), 1, 96, true, add_material(scene, lambertian(glm::vec3(1))));
    const int columns = 8, rows = 4;
    std::vector<std::uint32_t> texels;
    for (int i = 0; i < columns * rows; ++i) {
        texels.push_back(texel(8 * i, 255 - 7 * i, (37 * i) % 256));
    }
    add_texture(scene, 0, material_base_color_texture, columns, texels, true);
    for (const glm::vec3& p : scene.positions) {
        scene.uvs.emplace_back(0.5f + std::atan2(p.z, p.x) / (2 * pi),
                               std::acos(std::clamp(p.y, -1.0f, 1.0f)) / pi);
    }
    RenderSettings settings = settings_of(GetParam(), 4, 1);
    settings.photons = 1000;
    const glm::vec3 to_eye = glm::normalize(glm::vec3(1, 0.5f, 0.3f));
    scene.lights = {directional_light(-to_eye, glm::vec3(float(pi)))};
    for (int i = 0; i < columns * rows; ++i) {
        const float longitude = (float(i % columns) + 0.4f) / columns * 2 * pi - pi;
        const float polar = (float(i / columns) + 0.6f) / rows * pi;
        const glm::vec3 at(std::sin(polar) * std::cos(longitude), std::cos(polar),
                           std::sin(polar) * std::sin(longitude));
        const double cosine = glm::dot(at, to_eye);
        if (cosine < 0.2) {
            continue; // behind, or where the facets' edges matter
        }
        const glm::dvec3 l = radiance(scene, settings, at + 3.0f * to_eye, at, "direct");
        const auto color = std::bit_cast<glm::u8vec4>(texels[std::size_t(i)]);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(l[channel], linear(color[channel]) * cosine, 2e-3) << i << ", " << channel;
        }
    }
}

TEST_P(Textured, ReflectsTheVerticesColour) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f, 1, 1)), 1);
    for (const glm::vec3& p : scene.positions) { // 0 at x = -1, half at x = 1
        scene.colors.emplace_back(p.x > 0 ? glm::u16vec4(32768, 65535, 0, 65535)
                                          : glm::u16vec4(0, 65535, 65535, 65535));
    }
    scene.lights = {directional_light({0, -1, 0}, glm::vec3(float(pi)))};
    RenderSettings settings = settings_of(GetParam(), 4, 1);
    settings.photons = 1000;
    for (const float x : {-0.9f, 0.0f, 0.5f}) {
        const glm::vec3 to(x, 0, 0.3f);
        const glm::dvec3 l = radiance(scene, settings, to + glm::vec3(0, 3, 0.2f), to, "direct");
        const double share = (double(x) + 1) / 2;
        EXPECT_NEAR(l.r, 0.5 * share * 32768 / 65535, 1e-4) << x;
        EXPECT_NEAR(l.g, 1, 1e-4) << x;
        EXPECT_NEAR(l.b, 1 - share, 1e-4) << x;
    }
}

// A checkerboard with black squares, metal with varying roughness, and a perforated plate: photons
// and eye paths must see the same surfaces. Where a texel reflects nothing, photons must be stored
// for the estimates around it.
TEST_P(Textured, SlowLayersAgreeWithThePathTracer) {
    Scene scene = box_scene(lambertian({0.6f, 0.5f, 0.4f}));
    add_texture(scene, 0, material_base_color_texture, 2,
                {texel(255, 120, 120), texel(0, 0, 0), texel(40, 200, 90), texel(255, 255, 255)},
                true);
    add_quad(scene, {-0.5f, 0.95f, -0.5f}, {1, 0, 0}, {0, 0, 1},
             add_material(scene, emitter(glm::vec3(2))));
    Material metal = lambertian({0.9f, 0.8f, 0.6f});
    metal.metallic = 1;
    metal.specular = 1;
    metal.roughness = 0.9f;
    const std::uint32_t plate = add_material(scene, metal);
    add_texture(scene, plate, material_metal_texture, 2,
                {texel(0, 255, 255), texel(0, 100, 255), texel(0, 200, 0), texel(0, 255, 128)},
                true);
    add_floor(scene, 0.9f, -0.8f, plate);
    Material holes = lambertian(glm::vec3(0.7f));
    holes.alpha_mode = AlphaMode::mask;
    holes.alpha_threshold = 0.5f;
    const std::uint32_t perforated = add_material(scene, holes);
    add_texture(scene, perforated, material_base_color_texture, 2,
                {texel(255, 255, 255), texel(255, 255, 255, 0), texel(255, 255, 255, 0),
                 texel(200, 200, 100)},
                true);
    add_quad(scene, {-0.5f, 0.3f, 0.4f}, {1, 0, 0}, {0, 0, -0.8f}, perforated);
    project(scene, 0.31f);
    scene.cameras = {look_at({0.3f, -0.1f, 0.95f}, {0, -0.4f, -1}, 70)};
    RenderSettings reference = settings_of("path", 16, 4096);
    reference.seed = 7;
    const RenderResult& expected = render_once("textures", scene, reference);
    RenderSettings settings = settings_of(GetParam(), 16, has_map(GetParam()) ? 128 : 4096);
    settings.photons = 200'000;
    const RenderResult found = render(scene, settings);
    expect_same_layers(found, expected, 0.05);
    EXPECT_EQ(mean(layer(expected, "caustic")).g, 0); // light goes through the holes directly
}

/// A plate of 4 x 4 squares over a floor in the sun: every other one of texels with or without
/// alpha, or of those squares only that are there.
Scene checkered_plate(bool cut) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 2);
    add_checker(scene, lambertian({0.7f, 0.4f, 0.2f}), {0, 0.4f, 0}, {0, 0, 0.25f}, {0.25f, 0, 0},
                !cut);
    project(scene, 1);
    scene.lights = {directional_light({0.3f, -1, 0.2f}, glm::vec3(pi))};
    scene.cameras = {look_at({1.4f, 1, 1.6f}, {0.5f, 0.2f, 0.5f}, 40)};
    return scene;
}

TEST_P(Textured, MaskedTexelsAreNotThere) {
    RenderSettings settings = settings_of(GetParam(), 24, has_map(GetParam()) ? 16 : 256);
    settings.photons = 100'000;
    const RenderResult cut = render(checkered_plate(true), settings);
    expect_same_layers(render(checkered_plate(false), settings), cut, 0.02);
    EXPECT_GT(mean(layer(cut, "indirect")).g, 0.02 * mean(layer(cut, "direct")).g);
}

INSTANTIATE_ESTIMATES(Textured);

} // namespace
} // namespace argand::testing
