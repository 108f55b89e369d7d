// The computed sky against measured and published values, and its geometry.
#include "scene/atmosphere.hpp"

#include "scene/atmosphere_model.hpp"
#include "scene/environment_summary.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace argand {
namespace {

double luminance_of(const glm::dvec3& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

/// The texel in a direction of the world.
glm::dvec3 seen(const Environment& sky, const SkyPlace& place) {
    const double azimuth = place.azimuth + sky.rotation - 90; // from +X
    const double u = azimuth / 360 + 0.5;
    const double v = 0.5 - place.elevation / 180;
    const auto column = static_cast<int>((u - std::floor(u)) * sky.picture->width);
    const auto row = static_cast<int>(v * sky.picture->height);
    return glm::dvec3(
        sky.picture->texels[static_cast<std::size_t>(row * sky.picture->width + column)]);
}

double illuminance_of_sky(const Environment& sky) {
    const int rows = sky.picture->height / 2, width = sky.picture->width;
    glm::dvec3 sum(0);
    for (int row = 0; row < rows; ++row) {
        const double above = std::cos(std::numbers::pi * row / sky.picture->height);
        const double below = std::cos(std::numbers::pi * (row + 1) / sky.picture->height);
        for (int column = 0; column < width; ++column) {
            sum += glm::dvec3(sky.picture->texels[static_cast<std::size_t>(row * width + column)]) *
                   (std::numbers::pi * (above * above - below * below) / width);
        }
    }
    return luminance_of(sum);
}

// The solar illuminance constant is 133 klx, within a few percent by author.
TEST(Atmosphere, SunOutsideIsTheSolarConstant) {
    const glm::dvec3 color = color_of(Atmosphere::of_sun());
    EXPECT_NEAR(luminance_of(color), 133e3, 3e3);
    // Near white.
    EXPECT_NEAR(color.r / color.b, 1.1, 0.15);
}

// A vertical column is the scale height, but for the air above the shell; pure air lets through
// exp(-0.1085) at 550 nm.
TEST(Atmosphere, VerticalOpticalDepth) {
    const Spectrum pure = Atmosphere(1).transmittance(Atmosphere::ground, 1);
    constexpr std::size_t at_555 = 7;
    const double molecules = 1.24062e-6 / std::pow(0.555, 4) * 8000;
    // 300 Dobson units of ozone.
    const double ozone = 3.883e-25 * 300 * 2.687e20;
    EXPECT_NEAR(-std::log(pure[at_555]), molecules + ozone, 2e-3);
    // Turbidity compares optical depths: twice as much air and haze.
    const Spectrum hazy = Atmosphere(2).transmittance(Atmosphere::ground, 1);
    const double of_air = 1.24062e-6 / std::pow(0.55, 4) * 8000;
    EXPECT_NEAR(std::log(pure[at_555] / hazy[at_555]), of_air * std::pow(555.0 / 550, -1.3), 2e-3);
    // The slant path at 30 degrees is twice as long, but for the Earth's curvature.
    const Spectrum slanted = Atmosphere(1).transmittance(Atmosphere::ground, 0.5);
    EXPECT_NEAR(std::log(slanted[at_555]) / std::log(pure[at_555]), 2, 0.02);
    // At the horizon, where ozone hardly counts (430 nm): Chapman's sqrt(pi R/2H) for R/H = 795.
    constexpr std::size_t at_430 = 2;
    const Spectrum level = Atmosphere(1).transmittance(Atmosphere::ground, 0);
    EXPECT_NEAR(std::log(level[at_430]) / std::log(pure[at_430]),
                std::sqrt(0.5 * std::numbers::pi * 795), 0.7);
    EXPECT_EQ(Atmosphere(1).transmittance(Atmosphere::ground + 1, -0.1)[0], 0);
}

// Clear skies, turbidity 2 to 3, sun 60 degrees high (IESNA Lighting Handbook 2000, ch. 8; CIE
// S 011): direct normal 80 to 105 klx, sky 10 to 30 klx, zenith 3 to 9 kcd/m².
TEST(Atmosphere, LuminanceOfAClearSkyIsInTheMeasuredRange) {
    for (const double turbidity : {2.0, 3.0}) {
        const Environment sky = sun_and_sky({60, 180, turbidity});
        EXPECT_NEAR(luminance_of(illuminance_of_sun(sky)), 92.5e3, 12.5e3) << turbidity;
        EXPECT_NEAR(illuminance_of_sky(sky), 20e3, 10e3) << turbidity;
        EXPECT_NEAR(luminance_of(seen(sky, {89, 0})), 6e3, 3e3) << turbidity;
    }
}

TEST(Atmosphere, ColoursAreThoseOfTheSky) {
    const Environment noon = sun_and_sky({60, 180, 2.5});
    const glm::dvec3 zenith = seen(noon, {89, 0});
    EXPECT_GT(zenith.b, 1.3 * zenith.g);
    EXPECT_GT(zenith.g, zenith.r);
    EXPECT_GT(luminance_of(seen(noon, {57, 180})), 4 * luminance_of(seen(noon, {57, 0})))
        << "the sky is brightest around the sun";
    const Environment evening = sun_and_sky({2, 180, 2.5});
    const glm::dvec3 low_sun = illuminance_of_sun(evening);
    EXPECT_GT(low_sun.r, 4 * low_sun.g) << "a low sun is red";
    EXPECT_GT(low_sun.g, 4 * low_sun.b);
    EXPECT_LT(luminance_of(low_sun), 0.05 * luminance_of(illuminance_of_sun(noon)));
    const glm::dvec3 glow = seen(evening, {1, 180});
    EXPECT_GT(glow.r, 2 * glow.b);
    // More haze: whiter and brighter around the zenith, dimmer sun.
    const Environment hazy = sun_and_sky({60, 180, 6});
    const glm::dvec3 pale = seen(hazy, {89, 0});
    EXPECT_LT(pale.b / pale.r, zenith.b / zenith.r);
    EXPECT_LT(illuminance_of_sun(hazy).g, illuminance_of_sun(noon).g);
}

TEST(Atmosphere, BelowTheHorizon) {
    const Environment dusk = sun_and_sky({-4, 90, 2.5});
    EXPECT_FALSE(dusk.sun);
    // Civil twilight: 3.4 lux at -6 degrees, 400 lux or so at sunset.
    EXPECT_GT(illuminance_of_sky(dusk), 3);
    EXPECT_LT(illuminance_of_sky(dusk), 400);
    const Environment night = sun_and_sky({-30, 90, 2.5});
    EXPECT_FALSE(night.sun);
    EXPECT_LT(illuminance_of_sky(night), 1e-3);
    // Half of the disc is above the horizon at sunset.
    ASSERT_TRUE(sun_and_sky({0, 90, 1}).sun);
    for (const double elevation : {-90.0, -0.2, 0.1, 90.0}) {
        const Environment hazy = sun_and_sky({elevation, 0, 10});
        for (const glm::vec3& texel : hazy.picture->texels) {
            ASSERT_TRUE(std::isfinite(texel.r + texel.g + texel.b) && texel.r >= 0);
        }
    }
    // The ground reflects a fifth.
    const Environment noon = sun_and_sky({60, 180, 2.5});
    const double on_ground = illuminance_of_sky(noon) + luminance_of(illuminance_of_sun(noon)) *
                                                            std::sin(std::numbers::pi / 3);
    EXPECT_NEAR(luminance_of(seen(noon, {-45, 20})), 0.2 * on_ground / std::numbers::pi,
                0.001 * on_ground);
}

TEST(Atmosphere, SunStandsAtItsAzimuth) {
    // North is -Z, east +X.
    const struct {
        double azimuth;
        glm::dvec3 towards;
    } cases[] = {{0, {0, 0, -1}}, {90, {1, 0, 0}}, {180, {0, 0, 1}}, {270, {-1, 0, 0}}};
    for (const auto& c : cases) {
        const Environment sky = sun_and_sky({0, c.azimuth, 2});
        EXPECT_LT(glm::distance(rotated(sky, glm::dvec3(sky.sun->towards)), c.towards), 1e-6);
    }
    for (const SkyPlace& place : {SkyPlace{30, 77}, SkyPlace{-80, 200}, SkyPlace{0, 359}}) {
        const SkyPlace again = place_of(direction_of(place));
        EXPECT_NEAR(again.elevation, place.elevation, 1e-9);
        EXPECT_NEAR(again.azimuth, place.azimuth, 1e-9);
    }
}

} // namespace
} // namespace argand
