// Which samples a pixel takes, and which pixels are rendered.
#include "rendering.hpp"

#include <cmath>

namespace argand::testing {
namespace {

class PixelFilters : public EveryMethod {};

/// The plane z = 0 seen by parallel rays, 16 pixels of size 1/8 along each side. It shines where x
/// is less than `edge`.
Scene half_lit(float edge) {
    Scene scene;
    scene.name = "edge";
    const std::uint32_t white = add_material(scene, emitter(glm::vec3(1)));
    add_quad(scene, {-4, -4, 0}, {edge + 4, 0, 0}, {0, 8, 0}, white);
    scene.cameras = {parallel_rays({0, 0, 1}, {0, 0, 0}, 1)};
    return scene;
}

/// Share of the Blackman-Harris window of length 3 pixels that lies less than x pixels from its
/// middle on the right, or anywhere on the left; by the sum over a fine grid.
double share_left_of(double x) {
    constexpr int steps = 30'000;
    double before = 0, all = 0;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps, turn = 2 * double(pi) * t;
        const double w = 0.35875 - 0.48829 * std::cos(turn) + 0.14128 * std::cos(2 * turn) -
                         0.01168 * std::cos(3 * turn);
        all += w;
        before += 3 * t - 1.5 < x ? w : 0;
    }
    return before / all;
}

TEST_P(PixelFilters, WhiteStaysWhite) {
    RenderSettings settings = settings_of(GetParam(), 9, 4);
    settings.photons = 0;
    settings.filter = PixelFilter::blackman_harris;
    const RenderResult result = render(half_lit(4), settings);
    for (const glm::vec3& pixel : layer(result, "").pixels) {
        EXPECT_EQ(pixel, glm::vec3(1));
    }
}

TEST_P(PixelFilters, AnEdgeIsTheWindowsIntegral) {
    constexpr int size = 16;
    constexpr float edge = 0.04f;
    RenderSettings settings = settings_of(GetParam(), size, 256);
    settings.photons = 0;
    settings.filter = PixelFilter::blackman_harris;
    const RenderResult result = render(half_lit(edge), settings);
    const Image& image = layer(result, "");
    for (int x = 0; x < size; ++x) {
        const double middle = (x + 0.5) * 2 / size - 1;
        const double expected = share_left_of((double(edge) - middle) * size / 2);
        // The error of a stratified sum, averaged over the rows.
        EXPECT_NEAR(mean(image, x, 0, x + 1, size).g, expected, 0.003) << x;
    }
    settings.filter = PixelFilter::box;
    const RenderResult boxed = render(half_lit(edge), settings);
    EXPECT_NEAR(mean(layer(boxed, ""), 8, 0, 9, size).g, 8 * edge, 0.003);
    EXPECT_EQ(mean(layer(boxed, ""), 7, 0, 8, size).g, 1);
    EXPECT_EQ(mean(layer(boxed, ""), 9, 0, 10, size).g, 0);
}

TEST_P(PixelFilters, ACroppedPictureIsAPartOfTheWhole) {
    const Scene scene = load_asset("cornell_glass.glb");
    RenderSettings settings = settings_of(GetParam(), 24, 64);
    settings.height = 20;
    settings.photons = 50'000;
    const RenderResult whole = render(scene, settings);
    for (const CropRectangle& crop : {CropRectangle{5, 3, 18, 16}, CropRectangle{23, 19, 24, 20},
                                      CropRectangle{0, 0, 24, 20}}) {
        settings.crop = crop;
        const RenderResult part = render(scene, settings);
        ASSERT_EQ(part.layers.size(), whole.layers.size());
        for (std::size_t i = 0; i < part.layers.size(); ++i) {
            const Image& image = part.layers[i].image;
            ASSERT_EQ(image.width, crop.width());
            ASSERT_EQ(image.height, crop.height());
            Image expected{image.width, image.height, {}};
            for (int y = crop.y0; y < crop.y1; ++y) {
                const auto row = whole.layers[i].image.pixels.begin() + y * 24;
                expected.pixels.insert(expected.pixels.end(), row + crop.x0, row + crop.x1);
            }
            if (!has_map(GetParam())) {
                EXPECT_TRUE(same_bits(image, expected)) << whole.layers[i].name;
            } else if (crop.width() > 1) {
                EXPECT_RELATIVE(mean(image).g, mean(expected).g, 0.02) << whole.layers[i].name;
            }
        }
    }
}

INSTANTIATE_METHODS(PixelFilters);

} // namespace
} // namespace argand::testing
