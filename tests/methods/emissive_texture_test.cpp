// Surfaces that shine by their texels, rendered by every method.
#include "rendering.hpp"
#include "textured.hpp"

namespace argand::testing {
namespace {

class EmissiveTexture : public EveryMethod {};

constexpr std::uint32_t side = 4; // texels

/// Half of the texels are black, one is much brighter than the others.
std::vector<std::uint32_t> lamp_texels() {
    std::vector<std::uint32_t> texels(side * side, texel(0, 0, 0));
    for (std::uint32_t i = 0; i < texels.size(); i += 2) {
        texels[i] = texel(60, int(8 * i), 30);
    }
    texels[6] = texel(255, 200, 255);
    return texels;
}

/// A box under a lamp, with a mirror that reflects it.
Scene lit_box() {
    Scene scene = box_scene(lambertian({0.6f, 0.5f, 0.4f}));
    add_quad(scene, {-0.9f, -0.6f, 0.5f}, {0.8f, 0.2f, 0}, {0, 0, -0.8f},
             add_material(scene, mirror(glm::vec3(0.9f))));
    scene.cameras = {look_at({0.3f, 0.3f, 0.95f}, {0, -0.2f, -1}, 80)};
    return scene;
}

/// Its lamp shines by texels.
Scene by_texels() {
    Scene scene = lit_box();
    const std::uint32_t lamp = add_material(scene, emitter({6, 4, 5}));
    add_texture(scene, lamp, material_emissive_texture, side, lamp_texels(), true);
    scene.uvs.resize(scene.positions.size(), glm::vec2(0));
    add_quad(scene, {-0.5f, 0.95f, -0.5f}, {1, 0, 0}, {0, 0, 1}, lamp);
    for (std::size_t i = scene.uvs.size(); i < scene.positions.size(); ++i) {
        scene.uvs.emplace_back(scene.positions[i].x + 0.5f, scene.positions[i].z + 0.5f);
    }
    return scene;
}

/// Its lamp is made of a quad for each texel.
Scene by_pieces() {
    Scene scene = lit_box();
    const std::vector<std::uint32_t> texels = lamp_texels();
    for (std::uint32_t i = 0; i < texels.size(); ++i) {
        const auto color = std::bit_cast<glm::u8vec4>(texels[i]);
        const glm::vec3 radiance(6 * linear(color.r), 4 * linear(color.g), 5 * linear(color.b));
        const float size = 1.0f / side;
        add_quad(scene, {-0.5f + float(i % side) * size, 0.95f, -0.5f + float(i / side) * size},
                 {size, 0, 0}, {0, 0, size}, add_material(scene, emitter(radiance)));
    }
    return scene;
}

TEST_P(EmissiveTexture, SlowLightsLikeTheSameLampInPieces) {
    RenderSettings reference = settings_of("path", 16, 4096);
    reference.seed = 3;
    const RenderResult& expected = render_once("pieces", by_pieces(), reference);
    RenderSettings settings = settings_of(GetParam(), 16, has_map(GetParam()) ? 256 : 4096);
    settings.photons = 400'000;
    const RenderResult found = render(by_texels(), settings);
    expect_same_layers(found, expected, 0.03);
    EXPECT_GT(mean(layer(expected, "caustic")).g, 0.02 * mean(layer(expected, "direct")).g);
}

// One texel in a thousand shines, and neither the triangle's mean nor samples of its area tell
// where.
TEST_P(EmissiveTexture, FindsOneBrightTexel) {
    constexpr std::uint32_t texels_of_side = 64;
    constexpr float size = 4;
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)));
    const std::uint32_t lamp = add_material(scene, emitter({100, 200, 50}));
    std::vector<std::uint32_t> texels(texels_of_side * texels_of_side, texel(0, 0, 0));
    texels[40 * texels_of_side + 22] = texel(255, 255, 255);
    add_texture(scene, lamp, material_emissive_texture, texels_of_side, texels, true);
    scene.uvs.resize(scene.positions.size(), glm::vec2(0));
    const float corner = -size / 2;
    add_quad(scene, {corner, 1, corner}, {size, 0, 0}, {0, 0, size}, lamp);
    for (std::size_t i = scene.uvs.size(); i < scene.positions.size(); ++i) {
        scene.uvs.emplace_back(scene.positions[i].x / size + 0.5f,
                               scene.positions[i].z / size + 0.5f);
    }
    RenderSettings settings = settings_of(GetParam(), 4, 64);
    settings.photons = 1000;
    const float width = size / texels_of_side;
    const glm::vec3 to(0.1f, 0, -0.2f);
    const glm::vec3 texel_middle(corner + 22.5f * width, 1, corner + 40.5f * width);
    const glm::dvec3 l = radiance(scene, settings, to + glm::vec3(0.1f, 0.5f, 0.1f), to, "direct");
    const double distance = glm::distance(to, texel_middle);
    const double expected = 0.5 / double(pi) * double(width * width) / std::pow(distance, 4);
    EXPECT_RELATIVE(l.r, 100 * expected, 0.02);
    EXPECT_RELATIVE(l.g, 200 * expected, 0.02);
    EXPECT_RELATIVE(l.b, 50 * expected, 0.02);
}

/// A lamp of 4 x 4 squares under the ceiling of a box: every other one of texels with or without
/// alpha, or of those squares only that are there.
Scene lamp_with_holes(bool cut) {
    Scene scene = box_scene(lambertian({0.6f, 0.5f, 0.4f}));
    add_checker(scene, emitter({6, 4, 5}), {-0.5f, 0.9f, -0.5f}, {0.25f, 0, 0}, {0, 0, 0.25f},
                !cut);
    for (const glm::vec3& p : scene.positions) {
        scene.uvs.emplace_back(p.x + 0.5f, p.z + 0.5f);
    }
    scene.cameras = {look_at({0.3f, 0.3f, 0.95f}, {0, -0.2f, -1}, 80)};
    return scene;
}

TEST_P(EmissiveTexture, MaskedTexelsDoNotShine) {
    RenderSettings settings = settings_of(GetParam(), 16, has_map(GetParam()) ? 32 : 256);
    settings.photons = 100'000;
    const RenderResult cut = render(lamp_with_holes(true), settings);
    expect_same_layers(render(lamp_with_holes(false), settings), cut, 0.03);
}

INSTANTIATE_ESTIMATES(EmissiveTexture);

} // namespace
} // namespace argand::testing
