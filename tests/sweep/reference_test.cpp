#include "image/exr.hpp"
#include "image/metrics.hpp"
#include "support/expect_error.hpp"
#include "sweep/fake.hpp"

#include <array>

namespace argand::testing {
namespace {

RenderSettings small() {
    RenderSettings settings;
    settings.width = settings.height = 32;
    return settings;
}

const MethodInfo& path() { return builtin_methods().at("path"); }

TEST(Reference, AddsSamplesUntilItsErrorIsFarBelowThePilots) {
    FakeRenderer renderer;
    const std::array pilots{noisy(32, 32, 0, 0.2, 5), noisy(32, 32, 0, 0.06, 6)};
    const auto reference = render_reference(renderer.trials(), small(), pilots, 1e6, path());
    ASSERT_TRUE(reference);
    const double least = 0.06 * 0.06 / (1.01 * true_radiance * true_radiance);
    EXPECT_LT(*reference->own_error, 1.1 * reference_share * least);
    // Only its own error is left, of variance 1 / samples.
    EXPECT_NEAR(
        *reference->own_error,
        1 / (1.01 * true_radiance * true_radiance * static_cast<double>(reference->samples)),
        0.15 * *reference->own_error);
    EXPECT_GT(renderer.keys.size(), 3u);
}

TEST(Reference, KeepsItsTimeLimit) {
    FakeRenderer renderer;
    const std::array pilots{noisy(32, 32, 0, 0, 5)}; // no reference is accurate enough for this
    const auto reference = render_reference(renderer.trials(), small(), pilots, 0, path());
    ASSERT_TRUE(reference);
    EXPECT_EQ(renderer.keys.size(), 1u);
    EXPECT_GT(*reference->own_error, 0);
}

/// relMSE of the true image, divided by the least error, against pairs with noise of this deviation
/// in the first `noisy_rows` rows.
std::vector<double> true_errors_over_least(int noisy_rows) {
    constexpr int width = 32, pairs = 50;
    const Image truth = noisy(width, width, 0, 0, 0);
    const auto half = [&](std::uint32_t seed) {
        Image image = noisy(width, width, 0, 0.1, seed);
        std::copy(truth.pixels.begin() + noisy_rows * width, truth.pixels.end(),
                  image.pixels.begin() + noisy_rows * width);
        return image;
    };
    std::vector<double> ratios;
    for (std::uint32_t pair = 0; pair < pairs; ++pair) {
        Reference reference{.a = half(2 * pair + 1), .b = half(2 * pair + 2)};
        reference.own_error =
            rel_variance(std::array{reference.a, reference.b}, reference.a, reference.b) / 2;
        const double least = least_error_of(reference);
        EXPECT_LT(least, *reference.own_error);
        ratios.push_back(rel_mse(truth, reference.a, reference.b) / least);
    }
    return ratios;
}

TEST(Reference, ErrorsOfATrueImageAreAboutTheLeastError) {
    for (const int noisy_rows : {32, 2}) {
        double squares = 0;
        std::size_t within = 0;
        for (const double ratio : true_errors_over_least(noisy_rows)) {
            squares += ratio * ratio / 50;
            within += std::abs(ratio) < 1;
        }
        // About two standard deviations hold 95 %.
        EXPECT_GE(within, 45u) << noisy_rows;
        EXPECT_GT(std::sqrt(squares), 0.3) << noisy_rows;
    }
}

TEST(Reference, LeastErrorWithoutNoiseIsRounding) {
    const Image image = noisy(8, 8, 0, 0.1, 1);
    EXPECT_EQ(least_error_of({.a = image, .b = image, .own_error = 0}), rounding_error);
    EXPECT_EQ(least_error_of({.a = image, .b = image}), rounding_error);
    const Image black{1, 1, {glm::vec3(0)}};
    EXPECT_EQ(least_error_of({.a = black, .b = black, .own_error = 0}), rounding_error);
}

TEST(Reference, LeastErrorIsAtMostItsOwnError) {
    Image a = noisy(8, 8, 0, 0, 0), b = a;
    a.pixels[5] = glm::vec3(3); // all of the noise is in one pixel
    EXPECT_EQ(least_error_of({.a = a, .b = b, .own_error = 0.01}), 0.01);
}

TEST(Reference, CanBeInterrupted) {
    FakeRenderer renderer(0);
    EXPECT_FALSE(render_reference(renderer.trials(), small(), {}, 1, path()));
}

TEST(Reference, ReadsOneFileOrAPair) {
    const ScratchDirectory folder;
    write_exr(folder / "a.exr", std::array{Layer{"", noisy(8, 4, 0, 0.1, 1)}});
    write_exr(folder / "b.exr", std::array{Layer{"", noisy(8, 4, 0, 0.1, 2)}});
    EXPECT_FALSE(read_reference({folder / "a.exr"}, 8, 4).own_error);
    const Reference pair = read_reference({folder / "a.exr", folder / "b.exr"}, 8, 4);
    EXPECT_GT(*pair.own_error, 0);
    write_reference(folder / "kept.exr", pair);
    EXPECT_EQ(reread_reference(folder / "kept.exr").a.pixels, pair.a.pixels);
    EXPECT_EQ(reread_reference(folder / "kept.exr").b.pixels, pair.b.pixels);
    EXPECT_THAT(error_of([&] { read_reference({folder / "a.exr"}, 8, 8); }),
                ::testing::HasSubstr("--size 8x4"));
    EXPECT_THAT(error_of([&] { reread_reference(folder / "a.exr"); }),
                ::testing::HasSubstr("no sweep has written it"));
}

} // namespace
} // namespace argand::testing
