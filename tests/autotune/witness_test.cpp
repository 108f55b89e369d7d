#include "autotune/witness.hpp"
#include "support/noisy_image.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace argand {
namespace {

using testing::noisy;
using testing::true_radiance;

constexpr int side = 64;
constexpr Prior usual{.usual = 0.001, .factor = 2.5};

Testimony testimony(double value, double error) {
    return {.pixels = {value, error}, .smooth = {value, error}};
}

Image exact(double bias) { return noisy(side, side, bias, 0, 0); }

TEST(Witness, MeasuresSquaredBiasThroughItsOwnNoise) {
    const ImagePair picture{noisy(side, side, 0.4, 0.1, 1), noisy(side, side, 0.4, 0.1, 2)},
        witness{noisy(side, side, 0, 2, 3), noisy(side, side, 0, 2, 4)};
    const double expected = 0.16 / (1.01 * true_radiance * true_radiance);
    const Estimate bias = testimony_on(picture, witness, 1, exact(0)).pixels;
    EXPECT_GT(bias.error, 0.001);
    EXPECT_LT(bias.error, 0.02);
    EXPECT_NEAR(bias.value, expected, 3 * bias.error);
    // A witness that sees a quarter of the squared bias.
    const Estimate quarter = testimony_on(picture, witness, 0.25, exact(0)).pixels;
    EXPECT_NEAR(quarter.value, 4 * bias.value, 1e-9);
    EXPECT_NEAR(quarter.error, 4 * bias.error, 1e-9);
}

TEST(Witness, ConfirmsOnlyWhatItHasMeasured) {
    EXPECT_EQ(Judgement(usual, testimony(0.001, 0.001), 0.004).verdict(), Verdict::confirmed);
    EXPECT_EQ(Judgement(usual, testimony(0.03, 0.001), 0.004).verdict(), Verdict::refuted);
    // Without a testimony nothing is certain, however small the bias that is usual.
    const Testimony none = testimony(0, 1e9);
    EXPECT_EQ(Judgement(usual, none, 0.004).verdict(), Verdict::open);
    EXPECT_EQ(Judgement({.usual = 1e-5, .factor = 2.5}, none, 0.01).verdict(), Verdict::open);
    // Where no photons arrive, no bias is usual.
    EXPECT_EQ(Judgement({.usual = 0, .factor = 2.5}, none, 0.004).verdict(), Verdict::open);
    EXPECT_EQ(Judgement({.usual = 0, .factor = 2.5}, testimony(0.03, 0.001), 0.004).verdict(),
              Verdict::refuted);
}

TEST(Witness, DoesNotConfirmWhatOnlyTheUsualBiasSays) {
    // A usual bias far below the bound makes a larger one unlikely, whatever a noisy witness saw.
    constexpr Prior far_below{.usual = 1e-7, .factor = 2};
    EXPECT_EQ(Judgement(far_below, testimony(0, 0.008), 0.004).verdict(), Verdict::open);
    EXPECT_EQ(Judgement(far_below, testimony(0, 0.002), 0.004).verdict(), Verdict::confirmed);
}

TEST(Witness, AnExactTestimonyDecidesWithoutConfidence) {
    EXPECT_EQ(Judgement(usual, testimony(0.0037, 0.0005), 0.004).verdict(), Verdict::confirmed);
    EXPECT_EQ(Judgement(usual, testimony(0.0044, 0.0005), 0.004).verdict(), Verdict::refuted);
}

TEST(Witness, JudgesCausticsApart) {
    const auto with_caustics = [](double value, double error) {
        Testimony all = testimony(0.0005, 0.0005);
        all.caustics = {value, error};
        return Judgement(usual, all, 0.004);
    };
    EXPECT_EQ(with_caustics(0.001, 0.0002).verdict(), Verdict::confirmed);
    EXPECT_NEAR(with_caustics(0.001, 0.0002).bias().value, 0.0015, 0.0005);
    // However little bias there is in all other light.
    EXPECT_EQ(with_caustics(0.008, 0.0002).verdict(), Verdict::refuted);
    EXPECT_GT(with_caustics(0.008, 0.0002).bias().value, 0.008);
    // The noise of narrow passes keeps it open, and they must grow.
    const Judgement noisy_caustics = with_caustics(0.001, 0.005);
    EXPECT_EQ(noisy_caustics.verdict(), Verdict::open);
    EXPECT_TRUE(noisy_caustics.caustics_are_in_doubt());
    EXPECT_GT(noisy_caustics.growth(), with_caustics(0.001, 0.003).growth());
    EXPECT_FALSE(with_caustics(0.001, 0.0002).caustics_are_in_doubt());
}

TEST(Witness, SharpensWhereNarrowPicturesAgree) {
    const Image blurred = exact(1);
    const auto value = [&](double first, double second) {
        return sharpened_by({exact(first), exact(second)}, blurred).pixels[0].r - true_radiance;
    };
    EXPECT_NEAR(value(5, 3), 3, 1e-5);
    EXPECT_NEAR(value(0.2, 0), 0.2, 1e-5);
    EXPECT_NEAR(value(2, 0), 1, 1e-5);
}

TEST(Witness, GrowsAsItsErrorRequires) {
    const auto growth = [](double error) {
        return Judgement(usual, testimony(0.002, error), 0.004).growth();
    };
    EXPECT_GT(growth(0.001), 1);
    EXPECT_GT(growth(0.01), 2 * growth(0.001));
    EXPECT_LT(growth(1e9), 10);
}

TEST(Witness, FarTooBrightPicturesDoNotHideTheirError) {
    const ImagePair witness{noisy(side, side, 0, 0.5, 1), noisy(side, side, 0, 0.5, 2)};
    const Image leak = exact(1000);
    const ImagePair picture{leak, leak};
    EXPECT_LT(testimony_on(picture, witness, 1, leak).pixels.value, 1.1);
    EXPECT_GT(testimony_on(picture, witness, 1, darkened_by(witness, leak)).pixels.value, 1000);
    // A good guess stays.
    EXPECT_EQ(darkened_by(witness, exact(0)).pixels, exact(0).pixels);
}

/// Passes with an unbiased mean, each of `deviation`.
struct Passes {
    double deviation;
    std::uint64_t count = 0;
    std::vector<std::uint32_t> seeds{};
    std::vector<double> expected{};

    RenderPasses render() {
        return [this](const RenderSettings& settings, const OnPass& on_pass) {
            RenderResult result;
            Image mean = exact(-true_radiance);
            seeds.push_back(settings.seed);
            const auto layers = [&] {
                return std::vector<Layer>{{"", mean}, {"direct", exact(-true_radiance)}};
            };
            for (std::uint64_t done = 0;
                 const std::optional<PassPlan> plan = on_pass({done, layers});) {
                expected.push_back(plan->expected);
                const Image pass =
                    noisy(side, side, 0, deviation, static_cast<std::uint32_t>(++count));
                ++done;
                for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
                    mean.pixels[i] += (pass.pixels[i] - mean.pixels[i]) / static_cast<float>(done);
                }
            }
            return result;
        };
    }
};

TEST(Witness, GrowsByIndependentPassesOfBothHalves) {
    Passes passes{.deviation = 1};
    const RenderPasses render = passes.render();
    const MethodTable methods = builtin_methods();
    Witness witness(render, *methods.unbiased(), {.samples = 4, .seed = 7});
    EXPECT_FALSE(witness.images());
    EXPECT_TRUE(witness.render_more(2, 10, 5));
    EXPECT_TRUE(witness.render_more(6, 10, 5));
    EXPECT_EQ(witness.passes(), 8);
    EXPECT_EQ(passes.seeds, (std::vector<std::uint32_t>{8, 9}));
    EXPECT_TRUE(witness.truth());
    EXPECT_NEAR(witness.variance_per_pass(exact(0)) * 1.01 * true_radiance * true_radiance, 1, 0.1);
    // The unbiased method adds to pictures that exist.
    const ImagePair bright{exact(1), exact(1)};
    witness.add({.whole = bright, .estimated = bright, .caustic = bright}, 32, 1);
    EXPECT_EQ(witness.passes(), 16);
    EXPECT_NEAR(witness.images()->whole[0].pixels[0].r, true_radiance + 0.5, 1.5);
}

/// Adds to the pixels of a square of 4 x 4.
Image with_spot(Image image, float more) {
    for (int y = 8; y < 12; ++y) {
        for (int x = 8; x < 12; ++x) {
            image.pixels[static_cast<std::size_t>(y * side + x)] += more;
        }
    }
    return image;
}

TEST(Witness, TellsNoiseFromBiasInOnePlace) {
    // The blur of a small caustic: much bias in few pixels.
    const ImagePair picture{with_spot(noisy(side, side, 0, 0.1, 1), 3),
                            with_spot(noisy(side, side, 0, 0.1, 2), 3)},
        witness{noisy(side, side, 0, 0.1, 3), noisy(side, side, 0, 0.1, 4)};
    const double expected = 9 * 16 / (1.01 * true_radiance * true_radiance * side * side);
    const Estimate bias = testimony_on(picture, witness, 1, exact(0)).pixels;
    EXPECT_LT(bias.error, 0.2 * expected);
    EXPECT_NEAR(bias.value, expected, 4 * bias.error);
}

TEST(Witness, KnowsItsOwnNoise) {
    double squares = 0, told = 0;
    for (std::uint32_t i = 0; i < 32; ++i) {
        const auto next = [&](std::uint32_t k) { return noisy(side, side, 0, 0.5, 4 * i + k); };
        const Estimate none =
            testimony_on({next(0), next(1)}, {next(2), next(3)}, 1, exact(0)).pixels;
        // A negative mean counts as 0 with that much more error: half of the means are seen.
        squares += 2 * none.value * none.value / 32;
        told += (none.value > 0 ? 2 * none.error * none.error : 0) / 32;
    }
    EXPECT_GT(told / squares, 0.5);
    EXPECT_LT(told / squares, 2);
}

TEST(Witness, MeasuresTheBlurOfCausticsWithItsOwn) {
    const MethodTable methods = builtin_methods();
    Passes passes{.deviation = 0};
    const RenderPasses render = passes.render();
    Witness witness(render, methods.at("photons"), {.samples = 4}, times_passes_of_caustics);
    EXPECT_TRUE(witness.render_more(2, 10, 1));
    EXPECT_EQ(passes.expected, (std::vector<double>{729, 729}));
    // There is no layer of caustics: the passes see none. The law gives them a ninth of the blur.
    const ImagePair blur{exact(1 - true_radiance), exact(1 - true_radiance)};
    const double seen = 8.0 / 9,
                 expected = 1 / (seen * seen * 1.01 * true_radiance * true_radiance);
    EXPECT_NEAR(witness.testimony_on_caustics(blur, 1, exact(0)).value, expected, 1e-3 * expected);
}

TEST(Witness, WithBiasHasNarrowBandwidths) {
    Passes passes{.deviation = 1};
    const RenderPasses render = passes.render();
    const MethodTable methods = builtin_methods();
    Witness witness(render, methods.at("photons"), {.samples = 4});
    EXPECT_TRUE(witness.render_more(2, 10, 5));
    EXPECT_EQ(passes.expected, (std::vector<double>{320, 320}));
    EXPECT_FALSE(witness.truth());
    const ImagePair biased{exact(0.4), exact(0.4)};
    // The picture has the bandwidth of 5 passes, the witness half of that.
    const Testimony said = witness.testimony(biased, std::pow(5, -1 / 6.0), exact(0));
    const Testimony all = testimony_on(biased, witness.images()->whole, 1, exact(0));
    EXPECT_NEAR(said.pixels.value, 4 * all.pixels.value, 0.01 * std::abs(said.pixels.value));
}

} // namespace
} // namespace argand
