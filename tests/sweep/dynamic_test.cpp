// Errors of the frames of films, from images whose errors are known.
#include "device_fixture.hpp"
#include "image/mean.hpp"
#include "image/metrics.hpp"
#include "support/scratch_directory.hpp"
#include "sweep/dynamic.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace argand::testing {
namespace {

constexpr int film_side = 16;

/// The truth of a frame: a bright bar at this place before a grey wall.
Image truth_at(double frame) {
    Image image{.width = film_side, .height = film_side, .pixels = {}};
    for (int i = 0; i < film_side * film_side; ++i) {
        const double distance = i % film_side - 2 - frame;
        image.pixels.emplace_back(1 + std::exp(-0.5 * distance * distance));
    }
    return image;
}

/// References without noise of frames 0 to `end` - 1.
FilmReferences references_until(std::uint64_t end) {
    FilmReferences references;
    for (std::uint64_t frame = 0; frame < end; ++frame) {
        const Image truth = truth_at(double(frame));
        references[frame] = {.a = truth, .b = truth};
    }
    return references;
}

Image plus(Image image, float constant) {
    for (glm::vec3& pixel : image.pixels) {
        pixel += constant;
    }
    return image;
}

/// relMSE of an error of this size in every value.
double relative_square(const Image& truth, double error) {
    return rel_mse(plus(truth, float(error)), truth, truth);
}

TEST(FrameErrors, OfTheTruthAreNothing) {
    const std::vector<Image> images(2, truth_at(3)), before(2, truth_at(2));
    const FrameErrors errors = errors_of(3, images, before, references_until(5));
    EXPECT_EQ(errors.rel_mse, 0);
    EXPECT_EQ(errors.variance, 0);
    EXPECT_EQ(errors.squared_bias, 0);
    EXPECT_EQ(errors.lag, 0u);
    EXPECT_EQ(errors.flicker, 0);
}

TEST(FrameErrors, OfImagesThatAreLateTellByHowMuch) {
    for (const std::uint64_t lag : {0u, 1u, 3u}) {
        const std::vector<Image> images{plus(truth_at(4.0 - double(lag)), 0.01f),
                                        plus(truth_at(4.0 - double(lag)), -0.01f)};
        EXPECT_EQ(errors_of(4, images, {}, references_until(5)).lag, lag);
    }
    // Nearly two frames late.
    EXPECT_EQ(errors_of(4, std::vector<Image>(2, truth_at(2.2)), {}, references_until(5)).lag, 2u);
}

TEST(FrameErrors, SeparateBiasFromVariance) {
    const Image truth = truth_at(0);
    const FilmReferences references = references_until(1);
    const std::vector<Image> biased(3, plus(truth, 0.1f));
    FrameErrors errors = errors_of(0, biased, {}, references);
    EXPECT_NEAR(errors.squared_bias, relative_square(truth, 0.1), 1e-6);
    EXPECT_NEAR(errors.variance, 0, 1e-9);
    EXPECT_FALSE(errors.flicker);
    // Two seeds to either film_side of the bias: the unbiased variance is 2 d^2.
    const std::vector<Image> noisy{plus(truth, 0.1f + 0.05f), plus(truth, 0.1f - 0.05f)};
    errors = errors_of(0, noisy, {}, references);
    EXPECT_NEAR(errors.variance, 2 * relative_square(truth, 0.05), 1e-6);
    EXPECT_NEAR(errors.rel_mse, relative_square(truth, 0.1) + relative_square(truth, 0.05), 1e-6);
}

TEST(FrameErrors, FlickerIsTheErrorOfChanges) {
    const FilmReferences references = references_until(2);
    const Image truth = truth_at(1);
    // A bias that stays does not flicker; noise that changes its sign does, doubly.
    const std::vector<Image> steady(2, plus(truth, 0.1f)),
        steady_before(2, plus(truth_at(0), 0.1f));
    EXPECT_NEAR(*errors_of(1, steady, steady_before, references).flicker, 0, 1e-9);
    const std::vector<Image> before(2, plus(truth_at(0), -0.1f));
    const Image middle = mean_of(truth, truth_at(0));
    EXPECT_NEAR(*errors_of(1, steady, before, references).flicker, relative_square(middle, 0.2),
                1e-6);
}

TEST(FrameErrors, DoNotCountTheNoiseOfReferences) {
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0, 0.1f);
    const auto noisy = [&](Image image) {
        for (glm::vec3& pixel : image.pixels) {
            pixel += glm::vec3(noise(random), noise(random), noise(random));
        }
        return image;
    };
    double error = 0, flicker = 0;
    constexpr int repeats = 200;
    for (int i = 0; i < repeats; ++i) {
        FilmReferences references;
        for (const std::uint64_t frame : {0, 1}) {
            references[frame] = {.a = noisy(truth_at(double(frame))),
                                 .b = noisy(truth_at(double(frame)))};
        }
        const std::vector<Image> images(2, truth_at(1)), before(2, truth_at(0));
        const FrameErrors errors = errors_of(1, images, before, references);
        error += errors.rel_mse / repeats;
        flicker += *errors.flicker / repeats;
    }
    const double of_noise = relative_square(truth_at(1), 0.1);
    EXPECT_NEAR(error, 0, 0.02 * of_noise);
    EXPECT_NEAR(flicker, 0, 0.04 * of_noise);
}

class Films : public ::testing::Test {
protected:
    const DynamicScene film_{.name = "moving_light",
                             .file = ARGAND_SOURCE_DIR "/assets/moving_light.glb",
                             .fps = 8,
                             .frames = 3,
                             .references = {1, 2}};
    const ScratchDirectory folder_;
    const OpenDevice open_ = [] { return open_device(); };
    const std::function<bool()> go_on_ = [] { return true; };

    static RenderSettings settings(const std::string& method) {
        RenderSettings settings;
        settings.method = method;
        settings.width = settings.height = 12;
        settings.samples = 2;
        settings.photons = 2'000;
        return settings;
    }
};

TEST_F(Films, AreMeasuredFrameByFrame) {
    const auto references =
        film_references(open_, film_, settings("photons"), 8, folder_.path(), go_on_);
    ASSERT_TRUE(references);
    EXPECT_EQ(references->size(), 2u);
    const std::array<std::uint32_t, 2> seeds{1, 2};
    const auto frames = measure_film(open_, film_, settings("photons"), seeds, *references, go_on_);
    ASSERT_TRUE(frames);
    ASSERT_EQ(frames->size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const MeasuredFrame& frame = (*frames)[i];
        EXPECT_EQ(frame.frame, i);
        EXPECT_GT(frame.seconds, 0);
        EXPECT_GE(frame.update_seconds, 0);
        EXPECT_GT(frame.peak_bytes, 0u);
        EXPECT_EQ(frame.photons_emitted, 2'000);
        EXPECT_GT(frame.photons_stored, 0);
        EXPECT_EQ(frame.errors.has_value(), i > 0);
    }
    EXPECT_GT((*frames)[1].errors->rel_mse, 0);
    EXPECT_FALSE((*frames)[1].errors->flicker);
    EXPECT_TRUE((*frames)[2].errors->flicker);
}

TEST_F(Films, KeepTheirReferences) {
    const auto first = film_references(open_, film_, settings("path"), 2, folder_.path(), go_on_);
    EXPECT_EQ(folder_.names().size(), 2u);
    const auto opens_no_device = []() -> std::unique_ptr<Device> {
        ADD_FAILURE() << "rendered again";
        return open_device();
    };
    const auto again =
        film_references(opens_no_device, film_, settings("path"), 2, folder_.path(), go_on_);
    EXPECT_EQ(again->at(2).a.pixels, first->at(2).a.pixels);
    EXPECT_EQ(again->at(2).b.pixels, first->at(2).b.pixels);
    EXPECT_NE(first->at(2).a.pixels, first->at(2).b.pixels);
    // Another number of samples, or a light elsewhere, is another reference.
    film_references(open_, film_, settings("path"), 3, folder_.path(), go_on_);
    DynamicScene slower = film_;
    slower.fps = 4;
    film_references(open_, slower, settings("path"), 2, folder_.path(), go_on_);
    EXPECT_EQ(folder_.names().size(), 6u);
}

TEST_F(Films, HaveReferencesWithTheCausticsThatTheirScenesMayHave) {
    for (const std::string name : {"cornell_glass", "cornell_area"}) {
        const DynamicScene film{.name = name,
                                .file = ARGAND_SOURCE_DIR "/assets/" + name + ".glb",
                                .fps = 8,
                                .frames = 1,
                                .references = {0}};
        film_references(open_, film, settings("path"), 1, folder_.path(), go_on_);
    }
    EXPECT_THAT(folder_.names(),
                ::testing::UnorderedElementsAre(
                    ::testing::StartsWith("cornell_glass_0_12x12_bidirectional_1_"),
                    ::testing::StartsWith("cornell_area_0_12x12_path_1_")));
}

TEST_F(Films, EndWhereTheyAreInterrupted) {
    const auto never = [] { return false; };
    EXPECT_FALSE(film_references(open_, film_, settings("path"), 2, folder_.path(), never));
    EXPECT_TRUE(folder_.names().empty());
    const std::array<std::uint32_t, 2> seeds{1, 2};
    EXPECT_FALSE(measure_film(open_, film_, settings("path"), seeds, {}, never));
}

} // namespace
} // namespace argand::testing
