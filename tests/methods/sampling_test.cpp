// Quasi-random photons have less noise than random ones.
#include "rendering.hpp"

namespace argand::testing {
namespace {

/// Spread of renders that differ only in their seeds.
struct Spread {
    double mean = 0;     ///< of the indirect layer
    double variance = 0; ///< of a pixel of it, over the mean's square
};

class PhotonSampling : public RenderTest {
protected:
    Spread spread(Sampling sampling) {
        constexpr std::uint32_t renderings = 12;
        RenderSettings settings = settings_of("photons", 12, 16);
        settings.photons = 4096;
        settings.radius = 0.5;
        settings.bounces = 1; // the four numbers decide where a photon is stored
        settings.photon_sampling = sampling;
        std::vector<Image> images;
        Spread result;
        for (settings.seed = 1; settings.seed <= renderings; ++settings.seed) {
            images.push_back(layer(render(room_scene(), settings), "indirect"));
            result.mean += mean(images.back()).g / renderings;
        }
        const std::size_t pixels = images.front().pixels.size();
        for (std::size_t i = 0; i < pixels; ++i) {
            double of_pixel = 0;
            double squares = 0;
            for (const Image& image : images) {
                const double value = image.pixels[i].g;
                of_pixel += value / renderings;
                squares += value * value / renderings;
            }
            result.variance += (squares - of_pixel * of_pixel) / static_cast<double>(pixels);
        }
        result.variance /= result.mean * result.mean;
        return result;
    }
};

TEST_F(PhotonSampling, SobolPointsHaveTheMeanOfRandomNumbersAndLessVariance) {
    const Spread sobol = spread(Sampling::sobol);
    const Spread random = spread(Sampling::random);
    EXPECT_RELATIVE(sobol.mean, random.mean, 0.01);
    EXPECT_GT(random.variance, 0);
    EXPECT_LT(sobol.variance, 0.7 * random.variance);
}

} // namespace
} // namespace argand::testing
