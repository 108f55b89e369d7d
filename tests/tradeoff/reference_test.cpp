#include "fake.hpp"
#include "image/exr.hpp"
#include "image/metrics.hpp"
#include "support/expect_error.hpp"

#include <array>

namespace argand::testing {
namespace {

RenderSettings small() {
    RenderSettings settings;
    settings.width = settings.height = 32;
    return settings;
}

TEST(Reference, HasSamplesUntilItsErrorIsFarBelowThePilots) {
    FakeRenderer renderer;
    const std::array pilots{noisy(32, 32, 0, 0.2, 5), noisy(32, 32, 0, 0.06, 6)};
    const auto reference = render_reference(renderer.trials(), small(), pilots, 1e6);
    ASSERT_TRUE(reference);
    const double least = 0.06 * 0.06 / (1.01 * true_radiance * true_radiance);
    EXPECT_LT(*reference->own_error, 1.1 * reference_share * least);
    // Its own error is what is left: of variance 1 / samples.
    EXPECT_NEAR(*reference->own_error, 1 / (1.01 * true_radiance * true_radiance * static_cast<double>(reference->samples)),
                0.15 * *reference->own_error);
    EXPECT_GT(renderer.keys.size(), 3u);
}

TEST(Reference, KeepsToItsTime) {
    FakeRenderer renderer;
    const std::array pilots{noisy(32, 32, 0, 0, 5)};    // nothing is exact enough for this
    const auto reference = render_reference(renderer.trials(), small(), pilots, 0);
    ASSERT_TRUE(reference);
    EXPECT_EQ(renderer.keys.size(), 1u);
    EXPECT_GT(*reference->own_error, 0);
}

TEST(Reference, CanBeInterrupted) {
    FakeRenderer renderer(0);
    EXPECT_FALSE(render_reference(renderer.trials(), small(), {}, 1));
}

TEST(Reference, FilesAreOneOrAPair) {
    const ScratchDirectory folder;
    write_exr(folder / "a.exr", std::array{Layer{"", noisy(8, 4, 0, 0.1, 1)}});
    write_exr(folder / "b.exr", std::array{Layer{"", noisy(8, 4, 0, 0.1, 2)}});
    EXPECT_FALSE(read_reference({folder / "a.exr"}, 8, 4).own_error);
    const Reference pair = read_reference({folder / "a.exr", folder / "b.exr"}, 8, 4);
    EXPECT_GT(*pair.own_error, 0);
    write_reference(folder / "kept.exr", pair);
    EXPECT_EQ(reread_reference(folder / "kept.exr").a.pixels, pair.a.pixels);
    EXPECT_EQ(reread_reference(folder / "kept.exr").b.pixels, pair.b.pixels);
    EXPECT_THAT(error_of([&] { read_reference({folder / "a.exr"}, 8, 8); }), ::testing::HasSubstr("--size 8x4"));
    EXPECT_THAT(error_of([&] { reread_reference(folder / "a.exr"); }), ::testing::HasSubstr("not of a sweep"));
}

} // namespace
} // namespace argand::testing
