// Textures that are finer than the distance between paths: eye paths and photons see their mean.
#include "rendering.hpp"
#include "textured.hpp"

namespace argand::testing {
namespace {

/// A floor of a checkerboard of the linear albedos 1 and 0 in red, of 13 columns, so that its mean
/// is no mean of equal numbers. Squares are 1 / 16 wide. It reflects all blue light, so that no
/// roulette ends photons.
constexpr std::uint32_t columns = 13, rows = 16;

Scene board(float half) {
    Scene scene = floor_scene(lambertian(glm::vec3(1)), half);
    std::vector<std::uint32_t> texels;
    for (std::uint32_t i = 0; i < columns * rows; ++i) {
        const bool white = (i % columns + i / columns) % 2 == 0 && i % columns != 3;
        texels.push_back(white ? texel(255, 255, 255) : texel(0, 60, 255));
    }
    add_texture(scene, 0, material_base_color_texture, columns, texels, false);
    scene.textures[0].mips = true;
    scene.textures[0].transform[0].x = float(rows) / columns;
    project(scene, 1);
    return scene;
}

glm::dvec3 mean_albedo(const Scene& scene) {
    glm::dvec3 sum(0);
    for (const std::uint32_t t : scene.images[0]->texels) {
        const auto color = std::bit_cast<glm::u8vec4>(t);
        sum += glm::dvec3(linear(color.r), linear(color.g), linear(color.b));
    }
    return sum / double(columns * rows);
}

class MipMaps : public EveryMethod {};

TEST_P(MipMaps, ShowTheMeanAlbedoToEyePaths) {
    Scene scene = board(1000);
    scene.lights = {directional_light({0, -1, 0}, glm::vec3(float(pi)))};
    const glm::dvec3 expected = mean_albedo(scene);
    RenderSettings settings = settings_of(GetParam(), 8, 1);
    settings.photons = 1000;
    // From above, and at a low angle.
    for (const glm::vec3 from : {glm::vec3(1, 400, 2), glm::vec3(300, 60, 0)}) {
        scene.cameras = {look_at(from, {0, 0, 0}, 10)};
        const glm::dvec3 l = mean(layer(render(scene, settings), "direct"));
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_RELATIVE(l[channel], expected[channel], 0.001) << from.y << ", " << channel;
        }
    }
    // Near by, a pixel is a part of a square.
    scene.cameras = {look_at({0.03f, 0.1f, 0.03f}, {0.03f, 0, 0.0301f}, 1)};
    EXPECT_NEAR(mean(layer(render(scene, settings), "direct")).r, 1, 0.02);
}

TEST_F(RenderTest, SlowMipMapsShowTheMeanAlbedoToPhotons) {
    Scene scene = board(1000);
    scene.lights = {point_light({0, 100, 0}, glm::vec3(1))};
    scene.cameras = {look_at({1, 40, 2}, {0, 0, 0}, 10)};
    RenderSettings settings = settings_of("photons", 4, 1);
    settings.photons = 500'000;
    const auto& flux = render(scene, settings).statistics.flux;
    // The share of the light that meets the square; what it reflects escapes.
    const double arrives =
        std::atan(1000.0 * 1000 / (100 * std::sqrt(2 * 1000.0 * 1000 + 100 * 100))) / double(pi);
    const glm::dvec3 albedo = mean_albedo(scene);
    for (int channel = 0; channel < 2; ++channel) {
        const double absorbed = double(flux.absorbed[channel]) / double(flux.emitted[channel]);
        EXPECT_RELATIVE(absorbed, arrives * (1 - albedo[channel]), 0.001) << channel;
    }
}

INSTANTIATE_ESTIMATES(MipMaps);

} // namespace
} // namespace argand::testing
