// Quasi-random photons have less noise than random ones, and those of a lattice about the same.
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

class Lattice : public RenderTest {
protected:
    /// Renders the room with the points of a lattice.
    RenderResult deterministic(const std::string& method, std::uint32_t samples) {
        RenderSettings settings = settings_of(method, 12, samples);
        settings.photons = 40'000;
        settings.deterministic = true;
        return render(room_scene(), settings);
    }
};

TEST_F(Lattice, PathsConvergeToTheTruth) {
    RenderSettings settings = settings_of("path", 12, 4096);
    std::array<Image, 2> truth;
    for (Image& image : truth) {
        ++settings.seed;
        image = layer(render(room_scene(), settings), "");
    }
    double last = 1;
    for (const std::uint32_t samples : {16, 64, 256}) {
        const double error = rel_mse(layer(deterministic("path", samples), ""), truth[0], truth[1]);
        settings.samples = samples;
        const double scrambled =
            rel_mse(layer(render(room_scene(), settings), ""), truth[0], truth[1]);
        EXPECT_LT(error, 0.4 * last) << samples;
        EXPECT_LT(error, (samples > 16 ? 1.5 : 2) * scrambled) << samples;
        last = error;
    }
}

TEST_F(Lattice, PhotonsHaveTheLightOfScrambledPoints) {
    for (const char* method : {"photons", "footprints", "knn", "progressive"}) {
        RenderSettings settings = settings_of(method, 12, 64);
        settings.photons = 40'000;
        for (const char* name : {"direct", "indirect"}) {
            glm::dvec3 expected(0);
            for (settings.seed = 1; settings.seed <= 2; ++settings.seed) {
                expected += mean(layer(render(room_scene(), settings), name)) / 2.0;
            }
            const glm::dvec3 found = mean(layer(deterministic(method, 64), name));
            EXPECT_GT(expected.g, 0);
            EXPECT_RELATIVE(found.g, expected.g, 0.01) << method << ", " << name;
        }
    }
}

} // namespace
} // namespace argand::testing
