// Tone curves and the exposure that a picture gets by itself.
#include "image/pictures.hpp"
#include "image/png.hpp"
#include "image/srgb.hpp"
#include "image/tone.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

using namespace argand;
using namespace argand::testing;

namespace {

/// PBR Neutral as Khronos publishes it (specification of 2024, appendix), term by term.
glm::dvec3 published_neutral(glm::dvec3 c) {
    const double f90 = 0.04, ks = 0.8 - f90, kd = 0.15;
    const double x = std::min(c.r, std::min(c.g, c.b));
    const double f = x <= 2 * f90 ? x - x * x / (4 * f90) : f90;
    const double p = std::max(c.r, std::max(c.g, c.b)) - f;
    if (p <= ks) {
        return c - f;
    }
    const double pn = 1 - (1 - ks) * (1 - ks) / (p + 1 - 2 * ks);
    const double g = 1 / (kd * (p - pn) + 1);
    return (c - f) * (pn / p) * g + glm::dvec3(pn) * (1 - g);
}

std::vector<glm::dvec3> colors() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-12, 12), unit(0, 1);
    std::vector<glm::dvec3> all;
    for (int i = 0; i < 2000; ++i) {
        const double scale = std::exp2(i % 2 == 0 ? exponent(random) : unit(random) - 1);
        all.push_back(scale * glm::dvec3(unit(random), unit(random), unit(random)));
    }
    for (const double grey : {0.0, 0.04, 0.0799, 0.08, 0.0801, 0.76, 0.8, 1.0, 100.0}) {
        all.emplace_back(grey);
    }
    return all;
}

TEST(Tone, NeutralIsKhronosFormula) {
    for (const glm::dvec3& color : colors()) {
        const glm::dvec3 expected = published_neutral(color),
                         found = apply_tone(Tone::neutral, color);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[c], expected[c], 1e-12)
                << color.r << " " << color.g << " " << color.b;
        }
    }
}

// What the specification promises: colours without highlights differ by the reflection only.
TEST(Tone, NeutralKeepsColorsBelowTheHighlights) {
    const glm::dvec3 color(0.6, 0.3, 0.2);
    EXPECT_EQ(apply_tone(Tone::neutral, color), color - 0.04);
    const glm::dvec3 bright = apply_tone(Tone::neutral, {50, 5, 5});
    EXPECT_GT(bright.g, 0.5) << "bright colours fade towards white";
    EXPECT_LE(bright.r, 1);
}

// Values of Narkowicz's published curve, computed by hand.
TEST(Tone, FilmicIsNarkowiczCurve) {
    EXPECT_NEAR(apply_tone(Tone::filmic, glm::dvec3(0.18)).r, 0.086724 / 0.324932, 1e-12);
    EXPECT_NEAR(apply_tone(Tone::filmic, glm::dvec3(1)).r, 2.54 / 3.16, 1e-12);
    EXPECT_EQ(apply_tone(Tone::filmic, glm::dvec3(0)).r, 0);
}

TEST(Tone, CurvesRiseAndTakeAnyNumber) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const Tone tone : {Tone::linear, Tone::neutral, Tone::filmic}) {
        EXPECT_EQ(find_tone(name_of(tone)), tone);
        double last = 0;
        for (double grey = 1e-6; grey < 1e30; grey *= 1.01) {
            const double y = apply_tone(tone, glm::dvec3(grey)).g;
            EXPECT_GE(y, last) << name_of(tone) << ", " << grey;
            EXPECT_LE(y, 1);
            last = y;
        }
        for (const double odd : {-1.0, -infinity, std::nan("")}) {
            EXPECT_EQ(apply_tone(tone, glm::dvec3(odd)), glm::dvec3(0)) << name_of(tone);
        }
        const glm::dvec3 lamp = apply_tone(tone, {infinity, 0, 0});
        EXPECT_NEAR(lamp.r, 1, 1e-9) << name_of(tone);
    }
    EXPECT_FALSE(find_tone("vivid"));
}

TEST(Tone, PicturesAreEncodedAfterExposureAndCurve) {
    const Image image = constant(2, 1, {0.3f, 0.2f, 1.5f});
    const std::vector<std::uint8_t> bytes =
        srgb_bytes(image, {.exposure_ev = 1, .tone = Tone::neutral});
    const glm::dvec3 shown = published_neutral(2.0 * glm::dvec3(image.pixels[0]));
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(bytes[static_cast<std::size_t>(c)],
                  static_cast<int>(255 * srgb_encode(shown[c]) + 0.5));
    }
}

TEST(Exposure, BringsTheGeometricMeanToEighteenPercent) {
    Image image = constant(4, 4, glm::vec3(0.02f));
    EXPECT_NEAR(automatic_exposure(image), std::log2(0.18 / 0.02), 1e-6);
    image.pixels[0] = glm::vec3(0); // black does not count, nor does what is not finite
    image.pixels[1] = glm::vec3(std::numeric_limits<float>::infinity());
    EXPECT_NEAR(automatic_exposure(image), std::log2(0.18 / 0.02), 1e-6);
    for (std::size_t i = 2; i < 9; ++i) {
        image.pixels[i] = glm::vec3(2); // half of those that count
    }
    EXPECT_NEAR(automatic_exposure(image), std::log2(0.18 / 0.2), 1e-6);
    EXPECT_EQ(automatic_exposure(constant(3, 1, glm::vec3(0))), 0);
    EXPECT_EQ(automatic_exposure(constant(3, 1, glm::vec3(1e-38f))), 100);
}

} // namespace
